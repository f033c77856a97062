#include <gtest/gtest.h>
#include <cmath>

#include "tests/unit/gateway/machine/test_machine.hpp"

namespace dripline::machine::test {
namespace {

interpreter::Workpiece face_at(double z) {
  interpreter::Workpiece workpiece;
  workpiece.add(interpreter::ProbePlane{Axis::Z, Length::mm(z)});
  return workpiece;
}

interpreter::Probe probe_to(const Origin& origin, double from, double to,
                            interpreter::ProbeUntil until = interpreter::ProbeUntil::Contact) {
  return {.origin = origin,
          .from = Program::at(0, from),
          .to = Program::at(0, to),
          .until = until,
          .feed = Feed::per_minute(Length::mm(600)),
          .result = std::nullopt};
}

TEST(Probing, StopsAtTheSurfaceAfterAllThatWasQueued) {
  TestMachine test(plain_lathe(), face_at(-5));
  test.program.line(0, 10, 1200);
  test.program.output("before");
  const Origin& origin = test.program.begin_block();
  test.machine.begin_probe(probe_to(origin, 10, -20));
  const double seconds = test.run_all();
  EXPECT_NEAR(seconds, trapezoid(10, 20, 1000) + trapezoid(15, 10, 1000), 1e-9);
  ASSERT_EQ(test.recorder.probes.size(), 1u);
  EXPECT_TRUE(test.recorder.probes[0].result->tripped);
  EXPECT_NEAR(test.recorder.probes[0].result->at.linear(Axis::Z).mm(), -5, 1e-9);
  EXPECT_NEAR(test.z(), -5, 1e-9);
  EXPECT_EQ(test.recorder.lines,
            (std::vector<std::string>{"block 1", "output before", "block 2", "probed"}));
  test.program.end_block();
  EXPECT_TRUE(test.machine.poll_all().count() == 0);
  EXPECT_EQ(test.recorder.blocks.back(), 3u);
}

TEST(Probing, WithoutContactGoesToTheTarget) {
  TestMachine test(plain_lathe(), face_at(-50));
  const Origin& origin = test.program.begin_block();
  test.machine.begin_probe(probe_to(origin, 0, -20));
  test.run_all();
  EXPECT_FALSE(test.recorder.probes.at(0).result->tripped);
  EXPECT_EQ(test.z(), -20);
}

TEST(Probing, UntilReleaseStopsWhereTheSurfaceIsLeft) {
  TestMachine test(plain_lathe(), face_at(-5));
  test.machine.begin(Program::at(0, -8));
  const Origin& origin = test.program.begin_block();
  test.machine.begin_probe(probe_to(origin, -8, 10, interpreter::ProbeUntil::Release));
  test.run_all();
  EXPECT_TRUE(test.recorder.probes.at(0).result->tripped);
  EXPECT_NEAR(test.z(), -5, 1e-9);
}

TEST(Probing, NextMoveStartsWhereTheProbeStopped) {
  TestMachine test(plain_lathe(), face_at(-5));
  const Origin& origin = test.program.begin_block();
  test.machine.begin_probe(probe_to(origin, 0, -20));
  test.run_all();
  test.program.end_block();
  test.program.line(0, 5, 1200);
  EXPECT_NEAR(test.run_all(), trapezoid(10, 20, 1000), 1e-9);
}

TEST(Probing, CanBeHeldAndResumed) {
  TestMachine test(plain_lathe(), face_at(-5));
  const Origin& origin = test.program.begin_block();
  test.machine.begin_probe(probe_to(origin, 0, -20));
  test.machine.poll(Seconds{0.2});
  test.machine.hold();
  test.run_all();
  EXPECT_TRUE(test.recorder.probes.empty());
  test.machine.resume();
  test.run_all();
  EXPECT_EQ(test.recorder.probes.size(), 1u);
}

TEST(Probing, AbortedIsNotAnswered) {
  TestMachine test(plain_lathe(), face_at(-5));
  const Origin& origin = test.program.begin_block();
  test.machine.begin_probe(probe_to(origin, 0, -20));
  test.machine.poll(Seconds{0.2});
  test.machine.abort();
  test.run_all();
  EXPECT_EQ(test.recorder.lines, std::vector<std::string>{"aborted"});
}

TEST(Probing, OnAnArcStopsWhereItMeetsTheSurface) {
  TestMachine test(plain_lathe(), face_at(-5));
  test.machine.begin(Program::at(0, 10));
  const Origin& origin = test.program.begin_block();
  interpreter::Probe probe = probe_to(origin, 10, -10);
  probe.arc = interpreter::PathArc{
      {}, {}, interpreter::Plane::ZX, interpreter::Turn::Counterclockwise, Angle::degrees(180)};
  test.machine.begin_probe(probe);
  const double third = 10 * Angle::degrees(120).radians();
  EXPECT_NEAR(test.run_all(), trapezoid(third, 10, 1000), 1e-6);
  ASSERT_EQ(test.recorder.probes.size(), 1u);
  EXPECT_TRUE(test.recorder.probes[0].result->tripped);
  EXPECT_NEAR(test.z(), -5, 1e-9);
  EXPECT_NEAR(test.machine.status().position.raw(Axis::X), std::sqrt(75), 1e-9);
}

TEST(Probing, AtRapidTraverseNeedsNoFeed) {
  TestMachine test(plain_lathe(), face_at(-5));
  const Origin& origin = test.program.begin_block();
  interpreter::Probe probe = probe_to(origin, 0, -20);
  probe.feed = {};
  probe.is_rapid = true;
  test.machine.begin_probe(probe);
  const double seconds = test.run_all();
  EXPECT_NEAR(test.z(), -5, 1e-9);
  EXPECT_LT(seconds, trapezoid(5, 10, 1000)) << "quicker than at 600 mm/min";
}

}  // namespace
}  // namespace dripline::machine::test
