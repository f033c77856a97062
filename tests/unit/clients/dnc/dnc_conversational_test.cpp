#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/unit/clients/dnc/dnc_process.hpp"

namespace dripline {
namespace {

using test_support::Dnc;

class DncConversational : public testing::Test {
 protected:
  Dnc dnc{DNC_PATH};
};

TEST_F(DncConversational, PostsAFileOfEvents) {  // CEN-210
  dnc.write("a.toml",
            "[[event]]\ntype = \"program_setup\"\nprogram = 61\n"
            "[[event]]\ntype = \"position\"\nx = \"3/8\"\n[[event]]\ntype = \"end_of_program\"\n");
  const std::string program = "O0061\nG20 G93\nG0 X.375\nM5\nM9\n";
  EXPECT_EQ(dnc({"conversational", "post", "a.toml"}).out, program);
  const auto to_file = dnc({"conversational", "post", "a.toml", "-o", "O0061"});
  EXPECT_EQ(to_file.status, 0) << to_file.err;
  EXPECT_EQ(dnc.read("O0061"), program);
}

TEST_F(DncConversational, ListsInsertsAndDeletesEvents) {  // CEN-210
  const std::string file =
      "[[event]]\ntype = \"program_setup\"\nprogram = 61\n\n"
      "[[event]]\ntype = \"end_of_program\"\n";
  dnc.write("a.toml", file);
  const auto inserted = dnc({"conversational", "insert", "a.toml", "--before", "1", "--text",
                             "[[event]]\ntype = \"tool_call\"\ntool = 3"});
  EXPECT_EQ(inserted.status, 0) << inserted.err;
  const auto found = dnc({"conversational", "list", "a.toml", "--tool", "3", "--json"});
  EXPECT_EQ(
      nlohmann::json::parse(found.out).at("events"),
      nlohmann::json::parse(R"([{"event":1,"type":"tool_call","line":5,"fields":"tool = 3"}])"));
  EXPECT_EQ(dnc({"conversational", "list", "a.toml", "--type", "drill"}).out,
            "No event matches.\n");
  const auto refused = dnc({"conversational", "delete", "a.toml", "1..2"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.err,
            "dnc: a.toml: event 2 is the program's last: it is changed, not deleted\n");
  EXPECT_EQ(dnc({"conversational", "delete", "a.toml", "1-2"}).status, 2);
  EXPECT_EQ(dnc({"conversational", "delete", "a.toml", "1"}).status, 0);
  EXPECT_EQ(dnc.read("a.toml"), file);
}

TEST_F(DncConversational, NamesWhatIsWrongAndWritesNothing) {
  dnc.write("a.toml",
            "[[event]]\ntype = \"program_setup\"\nprogram = 61\n"
            "[[event]]\ntype = \"position\"\nx = \"3/0\"\n[[event]]\ntype = \"end_of_program\"\n");
  const auto refused = dnc({"conversational", "post", "a.toml", "-o", "O0061"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.err, "dnc: a.toml: event 1 (position), line 4: x = \"3/0\" divides by zero\n");
  EXPECT_EQ(dnc.read("O0061"), "");
  EXPECT_EQ(dnc({"conversational", "post", "none.toml"}).status, 2);
}

TEST_F(DncConversational, ListsEventsForPeopleAndPrograms) {
  const auto drill = dnc({"conversational", "events", "drill_dwell"});
  EXPECT_NE(drill.out.find("dwell"), std::string::npos) << drill.out;
  const auto json = nlohmann::json::parse(dnc({"conversational", "events", "--json"}).out);
  EXPECT_EQ(json["events"].size(), 36u);
  EXPECT_EQ(json["events"][0]["type"], "program_setup");
  EXPECT_EQ(json["events"][0]["fields"][0]["english"]["max"], 9999);
  EXPECT_EQ(dnc({"conversational", "events", "mill"}).status, 2);
}

TEST_F(DncConversational, StartsAJobThatPosts) {
  ASSERT_EQ(dnc({"conversational", "new", "--program", "88", "-o", "job.toml"}).status, 0);
  const auto posted = dnc({"conversational", "post", "job.toml"});
  EXPECT_EQ(posted.status, 0) << posted.err;
  EXPECT_TRUE(posted.out.starts_with("O0088 "));
}

}  // namespace
}  // namespace dripline
