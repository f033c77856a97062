#include <nlohmann/json.hpp>

#include "server/paths/program_paths.hpp"
#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::paths {
namespace {

using Json = nlohmann::json;

constexpr const char* kMilled = "O1\nG21 G90\nG0 X10.\nG1 Y5. F100.\nM30\n";

class ComparisonTest : public server_test::ServerTest {
 protected:
  ComparisonTest() {
    for (const char* control : {"fanuc", "other"}) catalog_.known.push_back(control);
  }

  Json compare(ComparisonRequest request) {
    const auto result = paths_.compare(request);
    EXPECT_TRUE(result) << result.error().what;
    return result ? Json::parse(*result) : Json();
  }
  ComparisonRequest two(const std::string& first, const std::string& second,
                        CompareBy by = CompareBy::Motion) {
    return {.first = push("O1", first, "fanuc"), .second = push("O1", second, "fanuc"), .by = by};
  }

  ProgramPaths paths_{
      machines::RunSources{.store = *store_, .releases = *releases_, .clock = clock_}};
};

TEST_F(ComparisonTest, TextHasItsLinesAndItsRevisions) {
  const Json result =
      compare(two(kMilled, "O1\nG21 G90\nG0 X11.\nG1 Y5. F100.\nM30\n", CompareBy::Text));
  EXPECT_EQ(result["same"], false);
  EXPECT_FALSE(result.contains("motion"));
  EXPECT_EQ(result["first"], (Json{{"program", "O1"}, {"revision", 1}, {"control", "fanuc"}}));
  EXPECT_EQ(result["second"]["revision"], 2);
  ASSERT_EQ(result["text"]["hunks"].size(), 1U);
  const Json& hunk = result["text"]["hunks"][0];
  EXPECT_EQ(hunk["before"], (Json{"O1", "G21 G90"}));
  EXPECT_EQ(hunk["first"], (Json{{"line", 3}, {"count", 1}, {"lines", {"G0 X10."}}}));
  EXPECT_EQ(hunk["second"]["lines"], Json{"G0 X11."});
  EXPECT_EQ(hunk["after"], (Json{"G1 Y5. F100.", "M30"}));
}

TEST_F(ComparisonTest, MotionIsThatOfTheMachinesSetup) {
  ASSERT_TRUE(setups_->save({.machine = "mill-1",
                             .control = "fanuc",
                             .text = "[[offset]]\nname = \"G55\"\nX = 100.0\n",
                             .comment = {}},
                            {"anna", "", ""}));
  auto request = two(kMilled, "O1\nG21 G90 G55\nG0 X10.\nG1 Y5. F100.\nM30\n");
  EXPECT_EQ(compare(request)["motion"]["same"], true);
  request.machine = "mill-1";
  const Json result = compare(request);
  EXPECT_EQ(result["motion"]["same"], false);
  EXPECT_EQ(result["machine"], "mill-1");
  EXPECT_EQ(result["class"], "offsets");
  EXPECT_EQ(result["motion"]["places"][0]["first"]["text"], "G0 X10.");
}

TEST_F(ComparisonTest, CalledProgramsAreThoseOfTheLibrary) {
  push("O2", "O2\nG0 X1.\nM99\n", "fanuc");
  const Json result = compare(two("O1\nG21\nM98 P2\nM30\n", "O1\nG21\nG0 X1.\nM30\n"));
  EXPECT_EQ(result["motion"]["same"], true) << result.dump(1);
}

TEST_F(ComparisonTest, AControlThatIsNotKnownIsComparedByItsTextAlone) {
  ComparisonRequest request{.first = push("A", "1\n", "other"),
                            .second = push("A", "2\n", "other")};
  EXPECT_EQ(compare(request)["same"], false);
  request.by = CompareBy::Motion;
  const auto refused = paths_.compare(request);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Unsupported);
}

TEST_F(ComparisonTest, TakesThePlaceOfAReader) {
  std::vector<std::unique_ptr<PathReader>> readers;
  auto request = two(kMilled, kMilled);
  for (int i = 0; i < ProgramPaths::kMaxReaders; ++i)
    readers.push_back(*paths_.open({.revision = request.first}));
  const auto refused = paths_.compare(request);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Busy);
  readers.pop_back();
  EXPECT_TRUE(paths_.compare(request));
}

}  // namespace
}  // namespace dripline::paths
