#include "gateway/interpreter/core/geometry/workpiece.hpp"

#include <gtest/gtest.h>
#include <cmath>

namespace dripline::interpreter {
namespace {

constexpr auto kContact = ProbeUntil::Contact;
constexpr auto kRelease = ProbeUntil::Release;

Position point(double x, double y, double z) {
  Position position;
  position.set(Axis::X, Length::mm(x));
  position.set(Axis::Y, Length::mm(y));
  position.set(Axis::Z, Length::mm(z));
  return position;
}
Position turned(double x, double z) {
  Position position;
  position.set(Axis::X, Length::mm(x));
  position.set(Axis::Z, Length::mm(z));
  return position;
}

void expect_at(const ProbeResult& result, double x, double y, double z) {
  EXPECT_TRUE(result.tripped);
  EXPECT_NEAR(result.at.linear(Axis::X).mm(), x, 1e-9);
  EXPECT_NEAR(result.at.linear(Axis::Y).mm(), y, 1e-9);
  EXPECT_NEAR(result.at.linear(Axis::Z).mm(), z, 1e-9);
}

Workpiece plane(Axis axis, double at) {
  Workpiece workpiece;
  workpiece.add(ProbePlane{axis, Length::mm(at)});
  return workpiece;
}
Workpiece profile(const std::vector<std::pair<double, double>>& points) {
  ProbeProfile outline;
  for (const auto& [x, z] : points) outline.points.push_back({Length::mm(x), Length::mm(z)});
  Workpiece workpiece;
  workpiece.add(std::move(outline));
  return workpiece;
}

TEST(Workpiece, NothingThereIsNotTrippedAndEndsAtTheTarget) {
  const ProbeResult result = Workpiece{}.probe(point(0, 0, 0), point(1, 2, -3), kContact);
  EXPECT_FALSE(result.tripped);
  EXPECT_TRUE(result.at.same_point(point(1, 2, -3)));
}

TEST(Workpiece, APlaneIsMetWhereTheMoveCrossesIt) {
  const Workpiece workpiece = plane(Axis::Z, -0.5);
  expect_at(workpiece.probe(point(0, 0, 1.5), point(4, 2, -2.5), kContact), 2, 1, -0.5);
  EXPECT_FALSE(workpiece.probe(point(0, 0, 2), point(0, 0, -0.4), kContact).tripped);
  EXPECT_FALSE(workpiece.probe(point(0, 0, 2), point(9, 0, 2), kContact).tripped);
  expect_at(workpiece.probe(point(0, 0, 2), point(0, 0, -0.5), kContact), 0, 0, -0.5);
}

TEST(Workpiece, AProbedPlaneIsReleasedAndMetAgain) {
  const Workpiece workpiece = plane(Axis::Z, -0.5);
  const Position on = point(0, 0, -0.5);
  expect_at(workpiece.probe(on, point(0, 0, 1), kRelease), 0, 0, -0.5);
  expect_at(workpiece.probe(on, point(0, 0, -1), kContact), 0, 0, -0.5);
  EXPECT_FALSE(workpiece.probe(on, point(0, 0, 1), kContact).tripped);
  EXPECT_FALSE(workpiece.probe(on, point(0, 0, -1), kRelease).tripped);
  expect_at(workpiece.probe(point(0, 0, -2), point(0, 0, 1), kRelease), 0, 0, -0.5);
}

TEST(Workpiece, AMoveThatBeginsUnderAPlaneAcrossZIsMetThere) {
  const Workpiece workpiece = plane(Axis::Z, -0.5);
  expect_at(workpiece.probe(point(1, 0, -2), point(1, 0, -9), kContact), 1, 0, -2);
  expect_at(workpiece.probe(point(1, 0, -2), point(3, 0, 4), kContact), 1, 0, -2);
  EXPECT_FALSE(workpiece.probe(point(1, 0, -2), point(9, 0, -2), kContact).tripped)
      << "sideways it meets the walls that other surfaces state";
}

TEST(Workpiece, APlaneAcrossXIsMetFromBothSides) {
  const Workpiece workpiece = plane(Axis::X, 10);
  expect_at(workpiece.probe(point(0, 0, 0), point(20, 0, 0), kContact), 10, 0, 0);
  expect_at(workpiece.probe(point(20, 0, 0), point(0, 0, 0), kContact), 10, 0, 0);
}

TEST(Workpiece, TheFirstSurfaceOfSeveralCounts) {
  Workpiece workpiece = plane(Axis::Z, -5);
  workpiece.add(ProbePlane{Axis::Z, Length::mm(-2)});
  workpiece.add(ProbePlane{Axis::Z, Length::mm(-8)});
  expect_at(workpiece.probe(point(0, 0, 0), point(0, 0, -10), kContact), 0, 0, -2);
}

TEST(Workpiece, ABoreIsMetFromInsideAndABossFromOutside) {
  Workpiece workpiece;
  workpiece.add(ProbeCylinder{Length::mm(10), Length::mm(5), Length::mm(3)});
  expect_at(workpiece.probe(point(10, 5, -1), point(20, 5, -1), kContact), 13, 5, -1);
  expect_at(workpiece.probe(point(0, 5, -1), point(20, 5, -1), kContact), 7, 5, -1);
  EXPECT_FALSE(workpiece.probe(point(0, 0, -1), point(20, 0, -1), kContact).tripped);
  EXPECT_FALSE(workpiece.probe(point(10, 5, 5), point(10, 5, -5), kContact).tripped);
}

TEST(Workpiece, AProfileIsMetOnItsFaceConeAndDiameter) {
  // A face to radius 10, a cone to radius 20, then the diameter.
  const Workpiece workpiece = profile({{0, 0}, {10, 0}, {20, -10}, {20, -40}});
  expect_at(workpiece.probe(turned(5, 3), turned(5, -3), kContact), 5, 0, 0);
  expect_at(workpiece.probe(turned(15, 3), turned(15, -30), kContact), 15, 0, -5);
  expect_at(workpiece.probe(turned(30, -20), turned(0, -20), kContact), 20, 0, -20);
  expect_at(workpiece.probe(turned(30, -60), turned(0, -60), kContact), 20, 0, -60);
  EXPECT_FALSE(workpiece.probe(turned(25, 3), turned(25, -60), kContact).tripped);
  EXPECT_FALSE(workpiece.probe(turned(20.5, 3), turned(20.5, -60), kContact).tripped);
  expect_at(workpiece.probe(turned(5, 3), turned(5, 0), kContact), 5, 0, 0);
}

TEST(Workpiece, DigitizingARisingProfileFindsEveryPoint) {
  // Contact, off, over by a step (which lands inside where the part rises), contact, off, contact.
  const Workpiece workpiece = profile({{0, 8}, {10, 3}, {20, -2}, {30, 1}});
  Position at = turned(29.5, 20);
  for (double x = 29.5; x > 1; x -= 0.5) {
    Position start = at;
    start.set(Axis::X, Length::mm(x));
    at = workpiece.probe(start, turned(x, -60), kContact).at;
    at = workpiece.probe(at, turned(x, 60), kRelease).at;
    const ProbeResult found = workpiece.probe(at, turned(x, -60), kContact);
    const double expected = x < 20 ? 8 - x / 2 : -2 + (x - 20) * 0.3;
    expect_at(found, x, 0, expected);
    const ProbeResult off = workpiece.probe(found.at, turned(x, 60), kRelease);
    expect_at(off, x, 0, expected);
    at = off.at;
  }
}

TEST(Workpiece, MovingOffOrAlongAProfileDoesNotMeetIt) {
  const Workpiece workpiece = profile({{0, 0}, {10, 0}, {10, -20}});
  EXPECT_FALSE(workpiece.probe(turned(5, 0), turned(5, 5), kContact).tripped);
  EXPECT_FALSE(workpiece.probe(turned(2, 0), turned(8, 0), kContact).tripped);
  EXPECT_FALSE(workpiece.probe(turned(10, -5), turned(10, -15), kContact).tripped);
  EXPECT_FALSE(workpiece.probe(turned(5, 5), turned(5, 9), kRelease).tripped);
}

TEST(Workpiece, AProfileWithAGrooveIsMetOnItsWalls) {
  const Workpiece workpiece =
      profile({{0, 0}, {10, 0}, {10, -5}, {6, -5}, {6, -9}, {10, -9}, {10, -20}});
  expect_at(workpiece.probe(turned(15, -7), turned(0, -7), kContact), 6, 0, -7);
  expect_at(workpiece.probe(turned(8, -7), turned(8, -20), kContact), 8, 0, -9);
  expect_at(workpiece.probe(turned(8, -7), turned(8, 5), kContact), 8, 0, -5);
}

TEST(Workpiece, OtherAxesStopInProportionAndAreMarked) {
  Position from = point(0, 0, 0);
  Position to = point(0, 0, -10);
  to.set(Axis::C, Angle::degrees(90));
  const ProbeResult result = plane(Axis::Z, -5).probe(from, to, kContact);
  EXPECT_DOUBLE_EQ(result.at.rotary(Axis::C).degrees(), 45);
  EXPECT_TRUE(result.at.has(Axis::C));
}

/// Counterclockwise about X0 Z0 in the plane ZX, from angle `from` (0 is +Z) by `sweep` degrees.
Probe around(double radius, double from, double sweep, ProbeUntil until = kContact) {
  const auto at = [radius](double degrees) {
    const double angle = Angle::degrees(degrees).radians();
    return turned(radius * std::sin(angle), radius * std::cos(angle));
  };
  Probe probe;
  probe.from = at(from);
  probe.to = at(from + sweep);
  probe.until = until;
  probe.arc = PathArc{{},
                      {},
                      Plane::ZX,
                      sweep > 0 ? Turn::Counterclockwise : Turn::Clockwise,
                      Angle::degrees(std::fabs(sweep))};
  return probe;
}

TEST(Workpiece, AnArcMeetsAPlaneWhereItCrossesIt) {
  const Workpiece face = plane(Axis::Z, -5);
  expect_at(face.probe(around(10, 0, 180)), 10 * std::sin(Angle::degrees(60).radians()), 0, -5);
  expect_at(face.probe(around(10, 0, -180)), -10 * std::sin(Angle::degrees(60).radians()), 0, -5);
  EXPECT_FALSE(face.probe(around(10, 0, 119.9)).tripped);
  EXPECT_FALSE(face.probe(around(4.9, 0, 360)).tripped);
  const Workpiece wall = plane(Axis::X, 8);
  expect_at(wall.probe(around(10, 0, 180)), 8, 0, 6);
  expect_at(wall.probe(around(10, 90, 90)), 8, 0, -6);
}

TEST(Workpiece, AnArcLeavesAPlaneThatItStartsOnAndMeetsItAgain) {
  const Workpiece face = plane(Axis::Z, 0);
  const Probe over = around(10, 270, 200);  // off the face at X-10, back onto it at X10
  expect_at(face.probe(over), 10, 0, 0);
  EXPECT_FALSE(face.probe(around(10, 270, 170)).tripped);
  expect_at(face.probe(around(10, 230, 170, kRelease)), -10, 0, 0);
  EXPECT_FALSE(face.probe(around(10, 80, 90, kRelease)).tripped);
}

TEST(Workpiece, AnArcMeetsAProfileAndACylinder) {
  const Workpiece cone = profile({{0, 0}, {5, 0}, {15, -10}, {15, -40}});  // X - 5 = -Z
  const double x = (5 + std::sqrt(2 * 144 - 25.0)) / 2;  // of the circle of radius 12
  expect_at(cone.probe(around(12, 0, 180)), x, 0, 5 - x);
  expect_at(cone.probe(around(12, 170, 100, kRelease)), 0, 0, -12);
  Workpiece boss;
  boss.add(ProbeCylinder{Length::mm(2), {}, Length::mm(4)});
  expect_at(boss.probe(around(10, 0, 180)), 6, 0, 8);
}

TEST(Workpiece, AnArcEndsAtItsTargetWithoutContact) {
  const ProbeResult missed = Workpiece{}.probe(around(10, 0, 270));
  EXPECT_FALSE(missed.tripped);
  EXPECT_TRUE(missed.at.same_point(around(10, 0, 270).to));
  Probe probe = around(10, 0, 270);
  probe.result = missed;
  EXPECT_DOUBLE_EQ(arc_of(probe).sweep.degrees(), 270);
  probe.result = plane(Axis::X, 10 * std::sin(Angle::degrees(210).radians())).probe(probe);
  EXPECT_NEAR(arc_of(probe).sweep.degrees(), 210, 1e-9) << "as far as the contact";
  probe.result = ProbeResult{true, probe.from};
  EXPECT_EQ(arc_of(probe).sweep.degrees(), 0);
}

}  // namespace
}  // namespace dripline::interpreter
