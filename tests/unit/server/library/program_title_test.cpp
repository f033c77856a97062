#include "server/library/program_title.hpp"

#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::server_test {
namespace {

using library::program_title;

/// CEN-212.
TEST(ProgramTitle, IsTheCommentOfTheFirstBlock) {
  EXPECT_EQ(program_title("%\nO0100 (FLANGE 40)\n(OTHER)\nG0\n"), "FLANGE 40");
  EXPECT_EQ(program_title("O0100\r\n( FLANGE )\r\nG0\r\n"), "FLANGE");
  EXPECT_EQ(program_title("(FLANGE)\nO0100\n"), "FLANGE");
  EXPECT_EQ(program_title("(SHIFT 2)\nO0100 (FLANGE)\n"), "FLANGE");
  EXPECT_EQ(program_title("(FLANGE)\nG0 X1 (FAST)\n"), "FLANGE");
  EXPECT_EQ(program_title("(FLANGE)\nO0100\n(SIDE 2)\n"), "FLANGE");
  EXPECT_EQ(program_title("O0100 ; flange\n"), "flange");
  EXPECT_EQ(program_title(":12(FLANGE)\n"), "FLANGE");
  EXPECT_EQ(program_title("O0100 (UNFINISHED"), "UNFINISHED");
}

TEST(ProgramTitle, IsTheFirstBlockWithoutAComment) {
  EXPECT_EQ(program_title("O100 FLANGE\nG0\n"), "FLANGE");
  EXPECT_EQ(program_title("G20 G90\nG0 (FAST)\n"), "G20 G90");
  EXPECT_EQ(program_title("O0100\nG0 (FAST)\n"), "") << "a later block's comment is no name";
  EXPECT_EQ(program_title(""), "");
  EXPECT_EQ(program_title("%\n\n%\n"), "");
  EXPECT_EQ(program_title("0 BEGIN PGM SHAFT MM\n"), "SHAFT");
}

TEST(ProgramTitle, IsShortAndHarmless) {
  EXPECT_EQ(program_title("O1(" + std::string(200, 'A') + ")").size(), library::kMaxTitle);
  EXPECT_EQ(program_title("O1(A\x1b[31mB)"), "A\\x1b[31mB");
  std::string umlauts;
  for (int i = 0; i < 60; ++i) umlauts += "\u00fc";
  const auto title = program_title("O1(x" + umlauts + ")");
  EXPECT_EQ(title.size(), 63u) << "x and 31 whole characters of two bytes";
}

class ProgramTitlesTest : public ServerTest {};

TEST_F(ProgramTitlesTest, BelongToAContent) {
  const auto one = push("O1", "O1 (ONE)\n");
  const auto two = push("O1", "O1 (TWO)\n");
  EXPECT_EQ(programs_->title(one), "ONE");
  EXPECT_EQ(programs_->title(two), "TWO");
  EXPECT_EQ(programs_->title(one), "ONE");
  storage::Revision none;
  EXPECT_EQ(programs_->title(none), "");
}

}  // namespace
}  // namespace dripline::server_test
