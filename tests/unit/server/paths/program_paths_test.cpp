#include "server/paths/program_paths.hpp"

#include <fmt/format.h>

#include "tests/unit/server/api/server_fixture.hpp"
#include "tests/unit/server/paths/decoded_path.hpp"

namespace dripline::paths {
namespace {

using paths_test::DecodedPath;

class PathsTest : public server_test::ServerTest {
 protected:
  PathsTest() { catalog_.known.push_back("fanuc"); }

  storage::Revision stored(const std::string& name, const std::string& text) {
    return push(name, text, "fanuc");
  }
  DecodedPath read(PathReader& reader) {
    DecodedPath path;
    for (;;) {
      const auto piece = reader.next();
      EXPECT_TRUE(piece);
      if (!piece || !*piece) return path;
      EXPECT_FALSE((*piece)->empty());
      path.add(**piece);
    }
  }
  DecodedPath path_of(const std::string& text, const std::string& machine = "") {
    auto reader = paths_.open({.revision = stored("O1", text), .machine = machine});
    EXPECT_TRUE(reader);
    return reader ? read(**reader) : DecodedPath();
  }

  ProgramPaths paths_{
      machines::RunSources{.store = *store_, .releases = *releases_, .clock = clock_}};
};

TEST_F(PathsTest, AProgramBecomesPointsBetweenBeginAndEnd) {
  const auto path = path_of("O1\nG21 G90\nG0 X10.\nG1 Y5. F100.\nM30\n");
  ASSERT_EQ(path.points.size(), 3U);
  EXPECT_EQ(path.points[2].line, 4);
  EXPECT_EQ(path.points[2].offset, 19);
  EXPECT_EQ(path.points[2].at, (std::array<std::int64_t, 3>{10'000, 5'000, 0}));
  EXPECT_EQ(path.notes.front()["kind"], "begin");
  EXPECT_EQ(path.notes.front()["control"], "fanuc");
  const auto& end = path.notes.back();
  EXPECT_EQ(end["kind"], "end");
  EXPECT_EQ(end["ended"], true);
  EXPECT_EQ(end["fault"], nullptr);
  EXPECT_EQ(end["extents"]["X"][1], 10.0);
  EXPECT_DOUBLE_EQ(end["feed_mm"].get<double>(), 5.0);
}

TEST_F(PathsTest, AnAlarmIsTheEndOfThePath) {
  const auto path = path_of("O1\nG21 G90\nG0 X10.\nG1 X1. F100. ZZ5.\nM30\n");
  EXPECT_EQ(path.points.size(), 2U);
  EXPECT_EQ(path.notes.back()["ended"], false);
  EXPECT_EQ(path.notes.back()["fault"]["line"], 4);
}

TEST_F(PathsTest, AProgramWithoutEndIsStopped) {
  const auto path = path_of("O1\nG21 G90\nN1 G0 X10.\nG0 X0.\nGOTO 1\n");
  EXPECT_EQ(path.notes.back()["ended"], false);
  EXPECT_NE(path.notes.back()["fault"], nullptr);
}

TEST_F(PathsTest, ALongProgramComesInPiecesOfBoundedSize) {
  std::string text = "O1\nG21 G90 F100.\n";
  for (int i = 0; i < 200'000; ++i) text += fmt::format("G1 X{}. Y{}.\n", i % 100, i % 77);
  auto reader = paths_.open({.revision = stored("O1", text + "M30\n")});
  ASSERT_TRUE(reader);
  DecodedPath path;
  int pieces = 0;
  for (;; ++pieces) {
    const auto piece = (*reader)->next();
    ASSERT_TRUE(piece);
    if (!*piece) break;
    EXPECT_LT((*piece)->size(), 512U * 1024);
    path.add(**piece);
  }
  EXPECT_GT(pieces, 4);
  EXPECT_EQ(path.points.size(), 200'000U);  // the first block moves nothing
}

TEST_F(PathsTest, TheSetupOfTheMachineApplies) {
  ASSERT_TRUE(setups_->save({.machine = "mill-1",
                             .control = "fanuc",
                             .text = "[[offset]]\nname = \"G54\"\nX = 100.0\n",
                             .comment = {}},
                            {"anna", "", ""}));
  const std::string text = "O1\nG21 G90 G54\nG0 X10.\nM30\n";
  EXPECT_EQ(path_of(text, "mill-1").points.back().at[0], 110'000);
  EXPECT_EQ(path_of(text, "mill-2").points.back().at[0], 10'000);
}

TEST_F(PathsTest, ACalledProgramComesFromTheLibrary) {
  stored("O9000", "O9000\nG1 X7. F100.\nM99\n");
  const auto path = path_of("O1\nG21 G90\nM98 P9000\nM30\n");
  EXPECT_EQ(path.points.back().at[0], 7000);
  EXPECT_EQ(path.points.back().line, 3);
}

TEST_F(PathsTest, OnlySoManyAreReadAtATimeAndAnEndedOneMakesRoom) {
  const auto revision = stored("O1", "O1\nM30\n");
  std::vector<std::unique_ptr<PathReader>> readers;
  readers.reserve(ProgramPaths::kMaxReaders);
  for (int i = 0; i < ProgramPaths::kMaxReaders; ++i)
    readers.push_back(paths_.open({.revision = revision}).value());
  const auto refused = paths_.open({.revision = revision});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Busy);
  readers.pop_back();
  EXPECT_TRUE(paths_.open({.revision = revision}));
}

TEST_F(PathsTest, AnUnknownControlIsRefused) {
  auto revision = stored("O1", "O1\nM30\n");
  revision.control = "";
  const auto refused = paths_.open({.revision = revision});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Unsupported);
}

}  // namespace
}  // namespace dripline::paths
