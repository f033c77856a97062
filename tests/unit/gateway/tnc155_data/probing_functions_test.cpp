#include "gateway/interpreter/tnc155/probing_functions.hpp"

#include <gtest/gtest.h>
#include <cmath>

// Rows: HD-207 (length), HD-208 (radius), HD-209 (basic rotation), HD-210 (surface), HD-211 and
// HD-212 (corner), HD-213 (circle), HD-215 (no contact).
namespace dripline::interpreter::tnc155 {
namespace {

Position at(double x, double y, double z) {
  Position position;
  position.set_raw(Axis::X, x);
  position.set_raw(Axis::Y, y);
  position.set_raw(Axis::Z, z);
  return position;
}
Touch towards(Axis axis, ProbeDirection direction, Position from) {
  return {from, axis, direction};
}
constexpr auto kUp = ProbeDirection::Positive;
constexpr auto kDown = ProbeDirection::Negative;

TEST(Touching, FindsASurfaceOrSaysThatThereIsNone) {
  Workpiece workpiece;
  workpiece.add(ProbePlane{Axis::Z, Length::mm(-3)});
  const Stylus stylus{2, 20};
  const auto found = touch(workpiece, stylus, towards(Axis::Z, kDown, at(1, 2, 10)));
  ASSERT_TRUE(found) << found.error().what;
  EXPECT_NEAR(found->raw(Axis::Z), -3, 1e-9);
  const auto none = touch(workpiece, stylus, towards(Axis::Z, kDown, at(1, 2, 30)));
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().what.find("TOUCH POINT INACCESSIBLE"), std::string::npos);
  EXPECT_FALSE(touch(workpiece, stylus, towards(Axis::Z, kDown, at(1, 2, -3)))) << "deflected";
}

TEST(Surfaces, CountTheTipAlongTheToolAndTheRimAcrossIt) {
  const Stylus stylus{1.5, 100};
  EXPECT_EQ(touched_coordinate(at(8.5, 0, 0), towards(Axis::X, kUp, {}), stylus, Axis::Z), 10);
  EXPECT_EQ(touched_coordinate(at(8.5, 0, 0), towards(Axis::X, kDown, {}), stylus, Axis::Z), 7);
  EXPECT_EQ(touched_coordinate(at(0, 0, -4), towards(Axis::Z, kDown, {}), stylus, Axis::Z), -4);
}

TEST(Calibrations, GiveLengthAndRadius) {
  EXPECT_EQ(calibrated_length(at(0, 0, 51.25), Axis::Z, 1.25), 50);
  // A ring of radius 25 about (10, 5): the ball's centre comes to 25 - 2.01 on every side.
  const Position touches[] = {at(32.99, 5, 0), at(-12.99, 5, 0), at(10, 27.99, 0),
                              at(10, -17.99, 0)};
  EXPECT_NEAR(*calibrated_radius(touches, Plane::XY, 25), 2.01, 1e-9);
  EXPECT_EQ(calibrated_radius(touches, Plane::XY, 20).error().code, Errc::LimitExceeded);
}

TEST(BasicRotations, AreTheSidesAngleWhicheverWayItIsTouched) {
  const double tangent = std::tan(3 * Angle::kPi / 180);
  const Position near = at(10, 10 * tangent, 0), far = at(90, 90 * tangent, 0);
  EXPECT_NEAR(*basic_rotation(near, far, Plane::XY, 0), 3, 1e-9);
  EXPECT_NEAR(*basic_rotation(far, near, Plane::XY, 0), 3, 1e-9);
  // A side along Y, nominally at +90, leans by 3 degrees towards -X.
  EXPECT_NEAR(*basic_rotation(at(-10 * tangent, 10, 0), at(-90 * tangent, 90, 0), Plane::XY, 90), 3,
              1e-9);
  EXPECT_FALSE(basic_rotation(near, near, Plane::XY, 0));
}

TEST(Corners, AreWhereTheWallsMeet) {
  const Stylus stylus{2, 100};
  // Walls y = 20 (touched from below) and x = 50 (touched from the left); the ball's centre is 2
  // in front of each.
  const Side bottom{towards(Axis::Y, kUp, {}), towards(Axis::Y, kUp, {}), at(10, 18, 0),
                    at(40, 18, 0)};
  const Side left{towards(Axis::X, kUp, {}), towards(Axis::X, kUp, {}), at(48, 30, 0),
                  at(48, 60, 0)};
  const auto square = corner(bottom, left, stylus, Plane::XY);
  ASSERT_TRUE(square) << square.error().what;
  EXPECT_NEAR(square->at.first, 50, 1e-9);
  EXPECT_NEAR(square->at.second, 20, 1e-9);
  EXPECT_NEAR(square->first_angle, 0, 1e-9);
  EXPECT_NEAR(square->second_angle, 90, 1e-9);
  EXPECT_EQ(corner(bottom, bottom, stylus, Plane::XY).error().code, Errc::LimitExceeded);
  // The points of a basic rotation serve as the first side: any two points of the wall do.
  const Side again{bottom.first, bottom.second, at(-5, 18, 0), at(-2, 18, 0)};
  EXPECT_NEAR(corner(again, left, stylus, Plane::XY)->at.first, 50, 1e-9);
}

TEST(Circles, AreMeasuredFromInsideAndOutside) {
  const Stylus stylus{2, 100};
  // Radius 30 about (7, -4): a bore is met at 28 from the centre, a boss at 32.
  const Position inside[] = {at(35, -4, 0), at(-21, -4, 0), at(7, 24, 0), at(7, -32, 0)};
  const auto bore = circle_centre(inside, Plane::XY, true, stylus);
  EXPECT_NEAR(bore.centre.first, 7, 1e-9);
  EXPECT_NEAR(bore.centre.second, -4, 1e-9);
  EXPECT_NEAR(bore.radius, 30, 1e-9);
  const Position outside[] = {at(-25, -4, 0), at(39, -4, 0), at(7, -36, 0), at(7, 28, 0)};
  const auto boss = circle_centre(outside, Plane::XY, false, stylus);
  EXPECT_NEAR(boss.centre.first, 7, 1e-9);
  EXPECT_NEAR(boss.radius, 30, 1e-9);
}

TEST(Circles, OfASimulatedBoreAreFound) {
  Workpiece workpiece;
  workpiece.add(ProbeCylinder{Length::mm(12), Length::mm(3), Length::mm(18)});
  const Stylus stylus{0, 100};
  std::vector<Position> touches;
  for (const auto& [axis, direction] : {std::pair(Axis::X, kUp), std::pair(Axis::X, kDown),
                                        std::pair(Axis::Y, kUp), std::pair(Axis::Y, kDown)}) {
    const auto found = touch(workpiece, stylus, towards(axis, direction, at(12, 3, -5)));
    ASSERT_TRUE(found) << found.error().what;
    touches.push_back(*found);
  }
  const auto circle =
      circle_centre(std::span<const Position, 4>(touches.data(), 4), Plane::XY, true, stylus);
  EXPECT_NEAR(circle.centre.first, 12, 1e-6);
  EXPECT_NEAR(circle.centre.second, 3, 1e-6);
  EXPECT_NEAR(circle.radius, 18, 1e-6);
}

}  // namespace
}  // namespace dripline::interpreter::tnc155
