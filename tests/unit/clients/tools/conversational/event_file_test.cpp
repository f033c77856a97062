#include "clients/tools/conversational/event_file.hpp"

#include <gtest/gtest.h>

#include "clients/tools/conversational/post.hpp"
#include "clients/tools/conversational/reader.hpp"

// CEN-210: the conversational editor's insert, delete and search of events.

namespace dripline::conversational {
namespace {

const std::string kFirstEvent = "# a pin\n\n[[event]]\ntype = \"program_setup\"\nprogram = 7\n\n";
const std::string kPosition = "# down\n[[event]]\ntype = \"position\"\nx = 1 # X\nz = \"1/2\"\n\n";
const std::string kLastEvent = "[[event]]\ntype = \"end_of_program\"\n";
const std::string kEventFile = kFirstEvent + kPosition + kLastEvent;

std::string text_of(const Result<std::string>& text) {
  return text ? *text : "error: " + text.error().what;
}

std::vector<std::size_t> numbers(const EventQuery& query) {
  std::vector<std::size_t> found;
  const auto events = list_events(kEventFile, query);
  EXPECT_TRUE(events) << events.error().what;
  for (const auto& event : events.value()) found.push_back(event.number);
  return found;
}

TEST(EventFile, ListsEventsWithTheirFieldsAsWritten) {
  const auto events = list_events(kEventFile, {}).value();
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[1].type, "position");
  EXPECT_EQ(events[1].line, 8);
  EXPECT_EQ(events[1].fields, "x = 1, z = \"1/2\"");
  EXPECT_EQ(events[2].fields, "");
}

TEST(EventFile, SearchesByTypeAndText) {
  using Numbers = std::vector<std::size_t>;
  EXPECT_EQ(numbers({.type = "position"}), Numbers{1});
  EXPECT_EQ(numbers({.tool = 3}), Numbers{});
  EXPECT_EQ(
      list_events(kFirstEvent + "[[event]]\ntype = \"tool_call\"\ntool = 3\n", {.tool = 3})->size(),
      1u);
  EXPECT_EQ(numbers({.text = "Z = \"1/2"}), Numbers{1});
  EXPECT_EQ(numbers({.type = "position", .text = "program"}), Numbers{});
}

TEST(EventFile, DeletesEventsWithTheCommentsAboveThem) {
  EXPECT_EQ(text_of(delete_events(kEventFile, 1, 1)), kFirstEvent + kLastEvent);
  EXPECT_EQ(text_of(delete_events(kFirstEvent + "[[event]]\ntype = \"mill\"\n" + kLastEvent, 1, 1)),
            kFirstEvent + kLastEvent)
      << "a faulty event is deleted too";
}

TEST(EventFile, DeletesNothingThatPostingThenMisses) {
  const auto event = [](const std::string& type, const std::string& fields = "") {
    return "[[event]]\ntype = \"" + type + "\"\n" + fields;
  };
  const std::string rough =
      event("rough_turning", "cut_increment = 0.1\nstart_x = 1\nstart_z = 0\npattern = 1\n");
  const std::string line = event("line", "feed = \"rapid\"\nx = 1\n");
  const std::string file = kFirstEvent + kPosition + rough + line + event("end_cycle") + kLastEvent;
  const auto posted = post(read_events(file).value());
  ASSERT_TRUE(posted) << posted.error().what;
  EXPECT_EQ(text_of(delete_events(file, 2, 2)),
            "error: without event 2 the file could not be posted: event 3 (end_cycle): no pattern "
            "has begun (numbered as it then is)");
  EXPECT_EQ(text_of(delete_events(file, 3, 4)),
            "error: without events 3 to 4 the file could not be posted: event 3 (end_of_program): "
            "pattern 1 has not ended: end_cycle is missing (numbered as it then is)");
  EXPECT_EQ(text_of(delete_events(file, 2, 4)), kFirstEvent + kPosition + kLastEvent);
  const std::string faulty = kFirstEvent + rough + kLastEvent;
  EXPECT_EQ(text_of(delete_events(faulty, 1, 1)), kFirstEvent + kLastEvent)
      << "a step to a good one";
}

TEST(EventFile, InsertsEventsBeforeOne) {
  const std::string added = "[[event]]\ntype = \"position\"\nx = 2";
  EXPECT_EQ(text_of(insert_events(kEventFile, 2, added)),
            kFirstEvent + kPosition + added + "\n\n" + kLastEvent);
  EXPECT_EQ(text_of(insert_events(kEventFile, 1, added)),
            kFirstEvent + added + "\n\n" + kPosition + kLastEvent);
}

TEST(EventFile, RefusesWithTheReason) {
  EXPECT_EQ(text_of(delete_events(kEventFile, 2, 3)),
            "error: event 3 is not there: the file has events 0 to 2");
  EXPECT_EQ(text_of(delete_events(kEventFile, 2, 1)),
            "error: events 2..1: the range runs backwards");
  EXPECT_EQ(text_of(delete_events(kEventFile, 0, 1)),
            "error: event 0 is the program's first: it is changed, not deleted");
  EXPECT_EQ(text_of(delete_events(kEventFile, 1, 2)),
            "error: event 2 is the program's last: it is changed, not deleted");
  EXPECT_EQ(text_of(insert_events(kEventFile, 0, kPosition)),
            "error: event 0 is the program's set-up: nothing is inserted before it");
  EXPECT_EQ(text_of(delete_events("{\"event\": []}", 0, 0)),
            "error: events of a JSON file are not edited: expected TOML");
  EXPECT_EQ(text_of(delete_events("event = [{type = \"line\"}, {type = \"line\"}]\n", 0, 0)),
            "error: event 0, line 1: expected [[event]] on a line of its own");
  EXPECT_EQ(text_of(insert_events(kEventFile, 1, "# nothing")),
            "error: there are no events to insert");
  EXPECT_EQ(text_of(insert_events(kEventFile, 2, "[[event]]\ntype = \"mill\"")),
            "error: event 2, line 13: type = \"mill\" is not an event");
}

}  // namespace
}  // namespace dripline::conversational
