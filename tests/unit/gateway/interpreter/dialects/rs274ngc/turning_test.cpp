#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/rs274ngc/interpreter.hpp"
#include "gateway/interpreter/dialects/rs274ngc/turning/roughing.hpp"
#include "tests/unit/gateway/interpreter/dialects/rs274ngc/control_run.hpp"

/// Rows: NGC-093
namespace dripline::interpreter::rs274ngc {
namespace {

constexpr std::string_view kLinuxCnc = "[control]\nprofile = \"linuxcnc\"\n";

TEST(Rs274Turning, AfterAnAlarmInTheContourTheToolIsWhereTheCycleBegan) {
  ControlRun run("G18 F10\no1 sub\nG0 X5 Z1\nG4 P1\no1 endsub\nG0 X10 Z3\nG71 Q1\nM2\n", kLinuxCnc);
  EXPECT_EQ(run.step(), StepState::Alarmed);
  const auto& interpreter = dynamic_cast<const Rs274NgcInterpreter&>(run.interpreter());
  EXPECT_EQ(interpreter.state()[Axis::X], 10);
  EXPECT_EQ(interpreter.state()[Axis::Z], 3);
}

TEST(Rs274Turning, APlanThatIsRefusedMovesNothing) {
  ControlRun run("G18 F10\no1 sub\nG0 X5 Z0\nG1 X6 Z-5\nX7 Z-3\no1 endsub\nG71 Q1 X10 Z1\nM2\n",
                 kLinuxCnc);
  EXPECT_EQ(run.step(), StepState::Alarmed);
  const auto& lines = run.log().lines();
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                          [](const std::string& line) {
                            return line.find("line") == 0 || line.find("arc") == 0;
                          }),
            0);
}

/// A valley of radius 3, and from its far edge down into another pocket at once.
const ContourPieces kTwoPockets{
    {.from = {0, 5}, .to = {6, 5}, .center = {3, 5}, .is_arc = true, .is_counterclockwise = true},
    {.from = {6, 5}, .to = {7, 2}},
    {.from = {7, 2}, .to = {8, 6}},
    {.from = {8, 6}, .to = {8, 10}}};

TEST(Rs274Turning, APocketBeginsAtItsTopAlsoAfterAValley) {
  const RoughingPlan plan{
      .contour = kTwoPockets, .start = {0, 10}, .increment = 1.5, .retract = 0.2};
  std::string_view why;
  const auto moves = rough(plan, ContourLimits(1), why);
  ASSERT_TRUE(moves) << why;
  for (const double level : {4.0, 2.5}) {
    EXPECT_TRUE(std::ranges::any_of(*moves, [&](const CutMove& move) {
      return move.kind == CutMove::Kind::Line && std::fabs(move.to.second - level) < 1e-9 &&
             move.to.first > 7;
    })) << level;
  }
}

TEST(Rs274Turning, AMoveBelowTheContourIsSeen) {
  const ContourLimits limits(1);
  const CutMoves above{{CutMove::Kind::Rapid, {8, 9}}};
  const CutMoves through{{CutMove::Kind::Rapid, {7, 2.5}}};
  EXPECT_TRUE(is_clear(above, {0, 6}, kTwoPockets, limits));
  EXPECT_FALSE(is_clear(through, {0, 6}, kTwoPockets, limits));
}

TEST(Rs274Turning, TheContourKeepsItsDistance) {
  std::string_view why;
  const auto aside = kept_off(kTwoPockets, 0.25, ContourLimits(1), why);
  ASSERT_TRUE(aside) << why;
  EXPECT_NEAR(aside->back().to.first, 7.75, 1e-9);
  for (const ContourPiece& piece : *aside) {
    for (const ContourPiece& each : kTwoPockets)
      EXPECT_GE(distance_to(each, point_on(piece, 0.5)), 0.25 - 1e-6);
  }
  EXPECT_FALSE(kept_off(kTwoPockets, 4, ContourLimits(1), why));
}

}  // namespace
}  // namespace dripline::interpreter::rs274ngc
