#include <gtest/gtest.h>

#include "tests/unit/gateway/machine/test_machine.hpp"

namespace dripline::machine::test {
namespace {

TEST(LookAhead, CollinearBlocksTakeAsLongAsOneMove) {
  TestMachine test;
  for (int i = 1; i <= 1000; ++i) test.program.line(0, i * 0.1, 1200);
  EXPECT_NEAR(test.run_all(), trapezoid(100, 20, 1000), 1e-9);
  EXPECT_EQ(test.recorder.blocks.size(), 1000u);
}

TEST(LookAhead, ReversalStops) {
  TestMachine test;
  test.program.line(0, 10, 1200);
  test.program.line(0, 0, 1200);
  EXPECT_NEAR(test.run_all(), 2 * trapezoid(10, 20, 1000), 1e-9);
}

TEST(LookAhead, CornerIsPassedAtTheSpeedOfItsCircle) {
  TestMachine test;
  test.program.line(0, 10, 1200);
  test.program.line(10, 10, 1200);
  // 90 degrees, 0.02 mm deviation: v^2 = a * d * sin(45) / (1 - sin(45))
  const double half = std::sqrt(0.5);
  const double corner = std::sqrt(1000 * 0.02 * half / (1 - half));
  const double lost = (20 - corner) * (20 - corner) / (2 * 1000 * 20);
  const double one_move = 10.0 / 20 + 20.0 / 2000 + lost;
  EXPECT_NEAR(test.run_all(), 2 * one_move, 1e-9);
}

TEST(LookAhead, RestsWhereTheProgramAsksForIt) {
  TestMachine test;
  test.program.line_to_rest(0, 10, 1200);
  test.program.line(0, 20, 1200);  // straight on: no corner by itself
  EXPECT_NEAR(test.run_all(), 2 * trapezoid(10, 20, 1000), 1e-9);
}

TEST(LookAhead, SharperCornersAreSlower) {
  double last = 1201;
  for (const double degrees : {5.0, 30.0, 60.0, 90.0, 120.0, 150.0, 179.0}) {
    TestMachine test;
    const double angle = degrees * Angle::kPi / 180;
    test.program.line(0, 10, 1200);
    test.program.line(10 * std::sin(angle), 10 + 10 * std::cos(angle), 1200);
    test.machine.poll_all(1);  // is exactly at the corner
    const double at_corner = test.machine.status().feed_per_minute;
    EXPECT_LE(at_corner, last) << degrees;
    last = at_corner;
  }
  EXPECT_LT(last, 30);
}

TEST(LookAhead, ContourOfShortBlocksKeepsItsFeed) {
  TestMachine test;
  const double radius = 20;
  const int blocks = 2000;
  test.machine.begin(Program::at(radius, 0));
  for (int i = 1; i <= blocks; ++i) {
    const double angle = Angle::kPi / 2 * i / blocks;
    test.program.line(radius * std::cos(angle), radius * std::sin(angle), 1200);
  }
  const double length = radius * Angle::kPi / 2;
  EXPECT_NEAR(test.run_all(), trapezoid(length, 20, 1000), length / 20 * 0.02);
}

TEST(LookAhead, ContourOfShortBlocksObeysTheCurvesAcceleration) {
  TestMachine test;
  const double radius = 0.5;
  const int blocks = 2000;
  test.machine.begin(Program::at(radius, 0));
  for (int i = 1; i <= blocks; ++i) {
    const double angle = 2 * Angle::kPi * i / blocks;
    test.program.line(radius * std::cos(angle), radius * std::sin(angle), 3000);
  }
  const double fastest = std::sqrt(1000 * std::sqrt(2) * radius);  // both axes together
  EXPECT_GT(test.run_all(), 2 * Angle::kPi * radius / fastest);
}

TEST(LookAhead, OutputBetweenMovesDoesNotStopThem) {
  TestMachine test;
  test.program.line(0, 10, 1200);
  test.program.output("half");
  test.program.line(0, 20, 1200);
  EXPECT_NEAR(test.run_all(), trapezoid(20, 20, 1000), 1e-9);
}

TEST(LookAhead, DwellStopsTheMoveBeforeIt) {
  TestMachine test;
  test.program.line(0, 10, 1200);
  test.program.dwell(0);
  test.program.line(0, 20, 1200);
  EXPECT_NEAR(test.run_all(), 2 * trapezoid(10, 20, 1000), 1e-9);
}

TEST(LookAhead, SlowsDownInTimeForSlowerBlocks) {
  TestMachine test;
  test.program.line(0, 10, 1200);
  test.program.line(0, 20, 300);
  const double slowing = (20 - 5) / 1000.0;
  const double first = 20.0 / 1000 + slowing + (10 - 0.2 - (400 - 25) / 2000.0) / 20;
  const double second = (10 - 0.0125) / 5 + 5.0 / 1000;
  EXPECT_NEAR(test.run_all(), first + second, 1e-9);
}

TEST(LookAhead, MovesThatArriveLaterAreStillBlendedIn) {
  TestMachine test;
  test.program.line(0, 10, 1200);
  const double first = test.machine.poll(Seconds{0.1}).count();
  test.program.line(0, 20, 1200);
  EXPECT_NEAR(first + test.run_all(), trapezoid(20, 20, 1000), 1e-9);
}

TEST(LookAhead, WindowsAreJoinedWithoutAStop) {
  TestMachine test;
  // Far more moves than one look-ahead window holds.
  for (int i = 1; i <= 8000; ++i) test.program.line(0, i * 0.01, 1200);
  EXPECT_NEAR(test.run_all(), trapezoid(80, 20, 1000), 1e-8);
}

TEST(LookAhead, BufferedSecondsAreThoseOfTheQueuedMotion) {
  TestMachine test;
  for (int i = 1; i <= 10; ++i) test.program.line(0, i * 10, 600);
  test.program.dwell(3);
  EXPECT_NEAR(test.machine.buffered().count(), 13, 1e-9);
  test.machine.poll(Seconds{5});
  EXPECT_NEAR(test.machine.buffered().count(), 8, 0.02);
  test.run_all();
  EXPECT_EQ(test.machine.buffered().count(), 0);
}

}  // namespace
}  // namespace dripline::machine::test
