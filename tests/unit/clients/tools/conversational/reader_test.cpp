#include "clients/tools/conversational/reader.hpp"

#include <gtest/gtest.h>

#include "clients/tools/conversational/catalog.hpp"
#include "tests/unit/clients/tools/conversational/posted_run.hpp"

namespace dripline::conversational {
namespace {

TEST(ConversationalReader, TakesJsonOfTheSameShape) {
  const std::string json = R"({"event": [
    {"type": "program_setup", "program": 7},
    {"type": "line", "feed": "rapid", "x": "7/8", "z": null},
    {"type": "miscellaneous", "work_coordinate": 2},
    {"type": "end_of_program", "spindle_off": false, "coolant_off": "no", "x": 0.5}]})";
  const auto events = read_events(json);
  ASSERT_TRUE(events) << events.error().what;
  EXPECT_EQ(*post(*events), "O0007\nG20 G93\nG0 X.875\nG55\nG53 G0 X.5\n");
}

TEST(ConversationalReader, RoundsFractionsToTheDecimalsOfTheField) {  // CEN-244
  EXPECT_EQ(posted(event("position", "x = \"1/3\"\nz = \"-5/64\"")), "G0 X.3333 Z-.0781\n");
  const std::string metric = event("program_setup", "program = 1\nunits = \"metric\"") +
                             event("position", "x = \"2/3\"") +
                             event("end_of_program", "spindle_off = false");
  EXPECT_NE(post(*read_events(metric))->find("G0 X.667\n"), std::string::npos);
}

TEST(ConversationalReader, NamesEventFieldValueAndLimit) {
  const auto error = [](const std::string& type, const std::string& fields) {
    return posted(event(type, fields));
  };
  EXPECT_EQ(error("line", "x = 1.23456"),
            "error: event 1 (line), line 4: x = 1.23456 has more than 4 decimals");
  EXPECT_EQ(error("line", "x = 100000"),
            "error: event 1 (line), line 4: x = 100000 is not between -99999.9999 and 99999.9999");
  EXPECT_EQ(error("tool_change", "tool = 25"),
            "error: event 1 (tool_change), line 4: tool = 25 is not between 0 and 24");
  EXPECT_EQ(error("tool_change", "tool = 1.5"),
            "error: event 1 (tool_change), line 4: tool = 1.5 has more than 0 decimals");
  EXPECT_EQ(error("drill", "z = -1"), "error: event 1 (drill), line 4: clearance is missing");
  EXPECT_EQ(error("line", "x = nan"),
            "error: event 1 (line), line 4: x = nan is not between -99999.9999 and 99999.9999");
  EXPECT_EQ(error("line", "x = \"half\""),
            "error: event 1 (line), line 4: x = \"half\" is not a number such as 1.25 or 5/16");
  EXPECT_EQ(error("line", "x = true"),
            "error: event 1 (line), line 4: x = true: expected a number");
  EXPECT_EQ(error("line", "x = 1\nxc = 2"),
            "error: event 1 (line), line 4: xc does not apply here (pole = absolute)");
  EXPECT_EQ(error("line", "corner = \"round\"\nx = 1"),
            "error: event 1 (line), line 4: corner_radius is missing");
  EXPECT_EQ(error("line", "feed = 1"),
            "error: event 1 (line), line 4: cartesian: x or z must be given");
  EXPECT_EQ(error("mirror", "y = 1\nx = 1"),
            "error: event 1 (mirror), line 4: y is not a field here; known are state, x, z");
  EXPECT_EQ(error("drill", "clearance = 1\nz = 0\nreturn = \"R\""),
            "error: event 1 (drill), line 4: return = \"R\": expected one of clearance, initial");
  EXPECT_EQ(error("tool_change", "tool = 1\ndescription = \"A(B\""),
            "error: event 1 (tool_change), line 4: description = \"A(B\": no parentheses inside a "
            "comment");
  EXPECT_EQ(error("miscellaneous", "text = \"A\\nB\""),
            "error: event 1 (miscellaneous), line 4: text has a character 0x0a: only those of "
            "plain text can be posted");
  EXPECT_EQ(error("miscellaneous", "spindle_mode = \"rpm\"\nmaximum_speed = 1800"),
            "error: event 1 (miscellaneous), line 4: maximum_speed does not apply here "
            "(spindle_mode = surface speed)");
  EXPECT_EQ(error("mill", ""), "error: event 1, line 4: type = \"mill\" is not an event");
  EXPECT_EQ(error("thread_line", "z = -1\nlead = 1\nthreads_per_unit = 4"),
            "error: event 1 (thread_line), line 4: either lead or threads_per_unit must be given");
}

TEST(ConversationalReader, RefusesFilesOfAnotherShape) {
  for (const std::string wrong :
       {"[event]\ntype = \"line\"", "[[line]]\nx = 1", "event = 3", "[[event]]\nx = 1",
        "[[event]]\ntype = \"line\"\nx = [1]", "{\"event\": {}}", "{\"event\": [3]}",
        "{\"event\": [{\"type\": \"line\", \"x\": [1]}]}", "{\"event\": [", "{\"events\": []}",
        "[[[[[[", "{\"event\": [[[[[[[[]]]]]]]]}"}) {
    const auto read = read_events(wrong);
    ASSERT_FALSE(read) << wrong;
    EXPECT_FALSE(read.error().what.empty());
  }
  EXPECT_EQ(read_events(std::string(kMaxFile + 1, ' ')).error().code, Errc::LimitExceeded);
}

TEST(ConversationalReader, TakesTheStarterFile) {
  const auto events = read_events(starter_file(31));
  ASSERT_TRUE(events) << events.error().what;
  const auto text = post(*events);
  ASSERT_TRUE(text) << text.error().what;
  EXPECT_TRUE(text->starts_with("O0031 (STEPPED PIN)\n"));
}

TEST(ConversationalCatalog, ListsEveryEventAndWhatItsFieldsTake) {
  const auto events = describe_events();
  EXPECT_EQ(events.size(), 36u);
  for (const auto& one : events) {
    for (const auto& field : one.fields) {
      EXPECT_FALSE(field.help.empty()) << one.type << '.' << field.name;
      EXPECT_EQ(field.kind == FieldKind::Choice, !field.choices.empty()) << one.type;
      EXPECT_LE(field.english.min, field.english.max) << one.type << '.' << field.name;
    }
  }
}

}  // namespace
}  // namespace dripline::conversational
