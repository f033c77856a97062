#include "clients/tools/tnc_probing/probing_functions.hpp"

#include <gtest/gtest.h>
#include <cmath>

// Rows: HD-207 (length), HD-208 (radius), HD-209 (basic rotation), HD-210 (surface), HD-211 and
// HD-212 (corner), HD-213 (circle), HD-215 (no contact).
namespace dripline::tnc_probing {
namespace {

using namespace interpreter;
using namespace interpreter::tnc155;

Position at(double x, double y, double z) {
  Position position;
  position.set_raw(Axis::X, x);
  position.set_raw(Axis::Y, y);
  position.set_raw(Axis::Z, z);
  return position;
}
Touch toward(Axis axis, ProbeDirection direction, Position from) {
  return {from, axis, direction};
}
constexpr auto kUp = ProbeDirection::Positive;
constexpr auto kDown = ProbeDirection::Negative;

TEST(Touching, FindsASurfaceOrSaysThatThereIsNone) {
  Workpiece workpiece;
  workpiece.add(ProbePlane{Axis::Z, Length::mm(-3)});
  const Stylus stylus{2, 20};
  const auto found = touch(workpiece, stylus, toward(Axis::Z, kDown, at(1, 2, 10)));
  ASSERT_TRUE(found) << found.error().what;
  EXPECT_NEAR(found->raw(Axis::Z), -3, 1e-9);
  const auto none = touch(workpiece, stylus, toward(Axis::Z, kDown, at(1, 2, 30)));
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().what.find("TOUCH POINT INACCESSIBLE"), std::string::npos);
  EXPECT_FALSE(touch(workpiece, stylus, toward(Axis::Z, kDown, at(1, 2, -3)))) << "deflected";
}

TEST(Surfaces, CountTheTipAlongTheToolAndTheRimAcrossIt) {
  const Stylus stylus{1.5, 100};
  EXPECT_EQ(touched_coordinate(at(8.5, 0, 0), toward(Axis::X, kUp, {}), stylus, Axis::Z), 10);
  EXPECT_EQ(touched_coordinate(at(8.5, 0, 0), toward(Axis::X, kDown, {}), stylus, Axis::Z), 7);
  EXPECT_EQ(touched_coordinate(at(0, 0, -4), toward(Axis::Z, kDown, {}), stylus, Axis::Z), -4);
}

TEST(Calibrations, GiveLengthAndRadius) {
  EXPECT_EQ(calibrated_length(at(0, 0, 51.25), Axis::Z, 1.25), 50);
  // A ring of radius 25 about (10, 5): the ball's center comes to 25 - 2.01 on every side.
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
  // A side along Y, nominally at +90, leans by 3 degrees toward -X.
  EXPECT_NEAR(*basic_rotation(at(-10 * tangent, 10, 0), at(-90 * tangent, 90, 0), Plane::XY, 90), 3,
              1e-9);
  EXPECT_FALSE(basic_rotation(near, near, Plane::XY, 0));
}

TEST(Corners, AreWhereTheWallsMeet) {
  const Stylus stylus{2, 100};
  // Walls y = 20 (touched from below) and x = 50 (touched from the left); the ball's center is 2
  // in front of each.
  const Side bottom{toward(Axis::Y, kUp, {}), toward(Axis::Y, kUp, {}), at(10, 18, 0),
                    at(40, 18, 0)};
  const Side left{toward(Axis::X, kUp, {}), toward(Axis::X, kUp, {}), at(48, 30, 0), at(48, 60, 0)};
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

// HD-211: the ball touches a wall that leans beside its center's line, by its radius.
TEST(Corners, OfAWorkpieceThatLiesAskewAreBesideTheTouches) {
  const Stylus stylus{2, 100};
  const double c = std::cos(30 * Angle::kPi / 180), s = 0.5;
  // A square corner at (50, 20), turned by 30 degrees: sides along (c, s) and (-s, c). Centers are
  // 2 in front of the walls: below the first, to the left of the second.
  const auto place = [&](double u, double v) {
    return at(50 + u * c - v * s, 20 + u * s + v * c, 0);
  };
  const Side bottom{toward(Axis::Y, kUp, {}), toward(Axis::Y, kUp, {}), place(10, -2),
                    place(40, -2)};
  const Side left{toward(Axis::X, kUp, {}), toward(Axis::X, kUp, {}), place(-2, 30), place(-2, 5)};
  const auto found = corner(bottom, left, stylus, Plane::XY);
  ASSERT_TRUE(found) << found.error().what;
  EXPECT_NEAR(found->at.first, 50, 1e-9);
  EXPECT_NEAR(found->at.second, 20, 1e-9);
  EXPECT_NEAR(found->first_angle, 30, 1e-9);
}

std::string refusal(ProbingFunction function, std::vector<Touch> touches, Axis tool = Axis::Z) {
  const auto checked = check_touches(function, touches, tool);
  return checked ? "" : checked.error().what;
}
Touch touch_along(Axis axis, ProbeDirection direction) {
  return toward(axis, direction, {});
}

// HD-208, HD-209, HD-211, HD-213: each function has its directions.
TEST(Touches, HaveTheDirectionsOfTheirFunction) {
  using enum ProbingFunction;
  const Touch x_up = touch_along(Axis::X, kUp), x_down = touch_along(Axis::X, kDown),
              y_up = touch_along(Axis::Y, kUp), y_down = touch_along(Axis::Y, kDown),
              z_up = touch_along(Axis::Z, kUp), z_down = touch_along(Axis::Z, kDown);
  for (const auto function : {Radius, Circle}) {
    EXPECT_EQ(refusal(function, {x_up, x_down, y_up, y_down}), "");
    EXPECT_EQ(refusal(function, {z_up, z_down, x_up, x_down}, Axis::Y), "") << "Z is first in ZX";
    EXPECT_EQ(refusal(function, {x_up, x_up, x_down, x_down}),
              "touch 2 is X+: expected X+, X-, Y+ and Y-, in this order");
  }
  EXPECT_EQ(refusal(Rotation, {y_down, y_down}), "");
  EXPECT_EQ(refusal(Rotation, {y_down, x_down}),
            "touch 2 is X-: expected Y-, as the other touch of this side");
  EXPECT_EQ(refusal(Rotation, {z_down, z_down}),
            "touch 1 is Z-: expected an axis across the tool, which is Z");
  EXPECT_EQ(refusal(Corner, {y_up, y_up, x_up, x_up}), "");
  EXPECT_EQ(refusal(Corner, {y_up, y_up, x_up, x_down}),
            "touch 4 is X-: expected X+, as the other touch of this side");
  EXPECT_EQ(refusal(Corner, {y_up, y_up, y_down, y_down}),
            "touch 3 is Y-: expected the other axis for the second side, the first has Y+");
  EXPECT_EQ(refusal(Corner, {y_up, y_up, x_up}), "4 touches are needed, 3 are there");
  EXPECT_EQ(refusal(Length, {x_up}), "touch 1 is X+: expected the tool's axis, Z");
  EXPECT_EQ(refusal(Length, {x_up}, Axis::X), "");
  EXPECT_EQ(refusal(Surface, {touch_along(Axis::C, kUp)}), "");
}

// HD-210: axis IV, whether it is rotary or parallel to another.
TEST(Surfaces, AreTouchedByTheFourthAxis) {
  Workpiece workpiece;
  workpiece.add(ProbePlane{Axis::Y, Length::mm(20)});
  const Stylus stylus{0, 100};
  // 40 from the axis: at Y 20 the stylus has gone round by 30 degrees, from either side.
  auto found = touch(workpiece, stylus, toward(Axis::C, kUp, at(40, 0, -5)));
  ASSERT_TRUE(found) << found.error().what;
  EXPECT_NEAR(found->raw(Axis::C), 30, 1e-4);
  EXPECT_EQ(found->raw(Axis::X), 40);
  Position turned = at(40, 0, -5);
  turned.set_raw(Axis::C, 80);
  found = touch(workpiece, stylus, toward(Axis::C, kDown, turned));
  ASSERT_TRUE(found) << found.error().what;
  EXPECT_NEAR(found->raw(Axis::C), 30, 1e-4);
  EXPECT_NE(touch(workpiece, {0, 20}, toward(Axis::C, kUp, at(40, 0, 0)))
                .error()
                .what.find("TOUCH POINT INACCESSIBLE: C+ from C 0 within 20 degrees"),
            std::string::npos);
  EXPECT_EQ(touch(workpiece, {1, 20}, toward(Axis::C, kUp, at(0, 0.5, 0))).error().code,
            Errc::LimitExceeded);
  // V goes along Y: from Y 5, V -3 to Y 20.
  Position parallel = at(0, 5, 0);
  parallel.set_raw(Axis::V, -3);
  found = touch(workpiece, stylus, toward(Axis::V, kUp, parallel));
  ASSERT_TRUE(found) << found.error().what;
  EXPECT_NEAR(found->raw(Axis::V), 15, 1e-9);
  EXPECT_EQ(found->raw(Axis::Y), 5);
  EXPECT_NEAR(touched_coordinate(*found, toward(Axis::V, kUp, parallel), {1.5, 100}, Axis::Z), 16.5,
              1e-9);
  // A ball of 2 touches a wall through the axis, 40 from it, asin(2 / 40) before its center is
  // there.
  EXPECT_NEAR(touched_coordinate(turned, toward(Axis::C, kUp, turned), {2, 100}, Axis::Z),
              80 + std::asin(0.05) * 180 / Angle::kPi, 1e-9);
}

// HD-210, HD-211, HD-213: after it the point has the coordinates that were entered.
TEST(Datums, MakeThePointBeCalledSoUnderABasicRotation) {
  Transformation frame;
  frame.datum = {100, 50, 7};
  frame.basic_rotation = 30;
  const Position point = at(113, 62, -5);
  const auto called = [&](const Transformation::Values& datum) {
    Transformation then = frame;
    then.datum = datum;
    return then.to_program({point.raw(Axis::X), point.raw(Axis::Y), point.raw(Axis::Z)});
  };
  const auto before = called(frame.datum);
  const NamedCoordinate both[] = {{Axis::X, 10}, {Axis::Y, 20}};
  const auto corner = called(datum_for(frame, point, both));
  EXPECT_NEAR(corner[0], 10, 1e-9);
  EXPECT_NEAR(corner[1], 20, 1e-9);
  EXPECT_NEAR(corner[2], before[2], 1e-9);
  const NamedCoordinate one[] = {{Axis::X, 3}};
  const auto surface = called(datum_for(frame, point, one));
  EXPECT_NEAR(surface[0], 3, 1e-9);
  EXPECT_NEAR(surface[1], before[1], 1e-9) << "only X was named";
}

TEST(Surfaces, OfAWorkpieceThatLiesAskewAreCompensatedAcrossThem) {
  Transformation frame;
  frame.basic_rotation = 90;
  const auto point = touched_point(at(5, 6, 7), toward(Axis::X, kUp, {}), {2, 100}, Axis::Z, frame);
  EXPECT_NEAR(point.raw(Axis::X), 5, 1e-9);
  EXPECT_NEAR(point.raw(Axis::Y), 8, 1e-9);
}

TEST(Circles, AreMeasuredFromInsideAndOutside) {
  const Stylus stylus{2, 100};
  // Radius 30 about (7, -4): a bore is met at 28 from the center, a boss at 32.
  const Position inside[] = {at(35, -4, 0), at(-21, -4, 0), at(7, 24, 0), at(7, -32, 0)};
  const auto bore = circle_center(inside, Plane::XY, true, stylus);
  EXPECT_NEAR(bore.center.first, 7, 1e-9);
  EXPECT_NEAR(bore.center.second, -4, 1e-9);
  EXPECT_NEAR(bore.radius, 30, 1e-9);
  const Position outside[] = {at(-25, -4, 0), at(39, -4, 0), at(7, -36, 0), at(7, 28, 0)};
  const auto boss = circle_center(outside, Plane::XY, false, stylus);
  EXPECT_NEAR(boss.center.first, 7, 1e-9);
  EXPECT_NEAR(boss.radius, 30, 1e-9);
}

TEST(Circles, OfASimulatedBoreAreFound) {
  Workpiece workpiece;
  workpiece.add(ProbeCylinder{Length::mm(12), Length::mm(3), Length::mm(18)});
  const Stylus stylus{0, 100};
  std::vector<Position> touches;
  for (const auto& [axis, direction] : {std::pair(Axis::X, kUp), std::pair(Axis::X, kDown),
                                        std::pair(Axis::Y, kUp), std::pair(Axis::Y, kDown)}) {
    const auto found = touch(workpiece, stylus, toward(axis, direction, at(12, 3, -5)));
    ASSERT_TRUE(found) << found.error().what;
    touches.push_back(*found);
  }
  const auto circle =
      circle_center(std::span<const Position, 4>(touches.data(), 4), Plane::XY, true, stylus);
  EXPECT_NEAR(circle.center.first, 12, 1e-6);
  EXPECT_NEAR(circle.center.second, 3, 1e-6);
  EXPECT_NEAR(circle.radius, 18, 1e-6);
}

}  // namespace
}  // namespace dripline::tnc_probing
