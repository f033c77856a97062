#include <nlohmann/json.hpp>

#include "server/paths/program_paths.hpp"
#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::paths {
namespace {

using Json = nlohmann::json;

class CheckTest : public server_test::ServerTest {
 protected:
  CheckTest() {
    for (const char* control : {"fanuc", "centurion", "other"}) catalog_.known.push_back(control);
  }

  Json check(const std::string& text, const std::string& control = "fanuc",
             const std::string& machine = {}) {
    const auto result = paths_.check({.revision = push("O1", text, control), .machine = machine});
    EXPECT_TRUE(result) << result.error().what;
    return result ? Json::parse(*result) : Json();
  }

  ProgramPaths paths_{
      machines::RunSources{.store = *store_, .releases = *releases_, .clock = clock_}};
};

TEST_F(CheckTest, AGoodProgramHasItsFiguresAndNoFindings) {
  const Json result = check("O1\nG21 G90 G94\nG0 X10.\nG1 Y60. F600.\nM30\n");
  EXPECT_EQ(result["outcome"], "ended") << result.dump(1);
  EXPECT_EQ(result["diagnostics"], Json::array());
  EXPECT_EQ(result["revision"], 1);
  EXPECT_EQ(result["feed_mm"], 60.0);
  EXPECT_NEAR(result["seconds"].get<double>(), 6, 0.2);
  EXPECT_EQ(result["extents"]["Y"], (Json{60.0, 60.0}));
  EXPECT_EQ(result["complete"], true);
}

TEST_F(CheckTest, AnAlarmHasItsPlace) {
  const Json result = check("O1\nG21 G90\nG1 X1. F100.\nG1 X2. ZZ5.\nM30\n");
  EXPECT_EQ(result["outcome"], "alarm");
  ASSERT_FALSE(result["diagnostics"].empty());
  const Json& alarm = result["diagnostics"].back();
  EXPECT_EQ(alarm["severity"], "alarm");
  EXPECT_EQ(alarm["line"], 4);
  EXPECT_GT(alarm["column"], 1);
  EXPECT_EQ(alarm["offset"], 24);  // of the block, where a text window begins
  EXPECT_EQ(alarm["program"], nullptr);
}

TEST_F(CheckTest, ALoopDoesNotHideWhatIsAfterIt) {
  std::string text = "O1\nG20 G90 F100.\n#1=1\nWHILE[#1LE2000]DO1\nG1 X1. F5\n#1=#1+1\nEND1\n";
  text += "G1 Y1. F6\nM30\n";  // a feed without a point warns
  const Json result = check(text);
  EXPECT_EQ(result["outcome"], "ended") << result.dump(1);
  std::map<int, int> times;
  for (const auto& found : result["diagnostics"]) times[found["line"]] = found["times"];
  EXPECT_EQ(times[5], 2000);
  EXPECT_EQ(times[8], 1);
  EXPECT_EQ(result["warnings"], 2001);
}

TEST_F(CheckTest, AFindingInACalledProgramNamesIt) {
  push("O2", "O2\nG0 X1.\nG1 Y1. ZZ5.\nM99\n", "fanuc");
  const Json result = check("O1\nG21\nM98 P2\nM30\n");
  ASSERT_FALSE(result["diagnostics"].empty()) << result.dump(1);
  EXPECT_TRUE(result["diagnostics"].back()["program"].is_string()) << result.dump(1);
  EXPECT_EQ(result["diagnostics"].back()["line"], 3);
}

TEST_F(CheckTest, AppliesTheSetupOfTheMachine) {
  ASSERT_TRUE(setups_->save({.machine = "mill-1",
                             .control = "fanuc",
                             .text = "[[offset]]\nname = \"G54\"\nX = 100.0\n",
                             .comment = {}},
                            {"anna", "", ""}));
  const std::string text = "O1\nG21 G90 G54\nG0 X10.\nG1 X20. F100.\nM30\n";
  EXPECT_EQ(check(text)["extents"]["X"][1], 20.0);
  const Json result = check(text, "fanuc", "mill-1");
  EXPECT_EQ(result["extents"]["X"][1], 120.0);
  EXPECT_EQ(result["machine"], "mill-1");
}

TEST_F(CheckTest, EndsWhenItsTimeIsOver) {
  std::string text = "O1\nG21 G90 F100.\n";
  for (int i = 0; i < 10'000; ++i) text += "G1 X1.\nX2.\n";
  const auto result = paths_.check(
      {.revision = push("O1", text + "M30\n", "fanuc"), .limit = std::chrono::milliseconds(0)});
  ASSERT_TRUE(result) << result.error().what;
  EXPECT_EQ(Json::parse(*result)["outcome"], "time");
  EXPECT_LT(Json::parse(*result)["blocks"], 20'000);
}

TEST_F(CheckTest, AControlThatIsNotKnownIsRefused) {
  const auto refused = paths_.check({.revision = push("A", "1\n", "other")});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Unsupported);
}

TEST_F(CheckTest, TakesThePlaceOfAReader) {
  const auto revision = push("O1", "O1\nG21\nM30\n", "fanuc");
  std::vector<std::unique_ptr<PathReader>> readers;
  for (int i = 0; i < ProgramPaths::kMaxReaders; ++i)
    readers.push_back(*paths_.open({.revision = revision}));
  const auto refused = paths_.check({.revision = revision});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Busy);
  readers.pop_back();
  EXPECT_TRUE(paths_.check({.revision = revision}));
}

}  // namespace
}  // namespace dripline::paths
