#pragma once

#include <gtest/gtest.h>

#include "gateway/interpreter/stages/blending/corner_blender.hpp"
#include "tests/unit/gateway/interpreter/stages/compensation/contour.hpp"

/// Contours for tests of blends: programmed in millimeters in the XY plane, one block per move.
namespace dripline::interpreter::blending {

using compensation::Move;
using compensation::PathLog;

class Path {
 public:
  explicit Path(const Policy& policy = {}, PlaneVector start = {}) : blender(policy, log) {
    set_in_plane(at_, axes_of(Plane::XY), start);
    blender.reset(at_);
    log.at = start;
  }

  Path& line(double first, double second) {
    set_in_plane(at_, axes_of(Plane::XY), {first, second});
    blender.on_line({next(), at_, feed});
    return end_block();
  }
  Path& rapid(double first, double second) {
    set_in_plane(at_, axes_of(Plane::XY), {first, second});
    blender.on_rapid({next(), at_});
    return end_block();
  }
  /// To the left with a positive sweep in degrees, about `center`.
  Path& arc(PlaneVector center, double sweep_degrees) {
    const PlaneVector out = in_plane(at_, axes_of(Plane::XY)) - center;
    const double turn = Angle::degrees(sweep_degrees).radians();
    const PlaneVector end = center + std::cos(turn) * out + std::sin(turn) * left_of(out);
    return arc_to(center, end, sweep_degrees);
  }
  /// The sweep is that of the programmed end; an approximate end may be anywhere.
  Path& arc_to(PlaneVector center, PlaneVector end, double sweep_degrees) {
    set_in_plane(at_, axes_of(Plane::XY), end);
    Arc arc;
    arc.origin = next();
    arc.to = at_;
    arc.center_first = Length::mm(center.first);
    arc.center_second = Length::mm(center.second);
    arc.turn = sweep_degrees > 0 ? Turn::Counterclockwise : Turn::Clockwise;
    arc.sweep = Angle::degrees(std::fabs(sweep_degrees));
    arc.feed = feed;
    blender.on_arc(arc);
    return end_block();
  }
  Path& round(double radius, std::optional<Feed> own = {}) {
    blender.round_next_corner(Length::mm(radius), own);
    return *this;
  }
  Path& chamfer(double size, Chamfer measure = Chamfer::Leg) {
    blender.chamfer_next_corner(Length::mm(size), measure);
    return *this;
  }
  Path& approximate(double radius = 0, double tolerance = 0.01) {
    blender.approximate_end(Length::mm(tolerance), Length::mm(radius));
    return *this;
  }
  Path& back(double degrees, Back which = Back::Nearest) {
    blender.back_solve_line(Angle::degrees(degrees), which);
    return *this;
  }
  Path& misc(int code) {
    blender.on_miscellaneous({next(), code});
    return end_block();
  }
  /// Along the axis across the plane.
  Path& aside(double to) {
    at_.set(Axis::Z, Length::mm(to));
    blender.on_line({next(), at_, feed});
    return end_block();
  }
  /// A block of its own that rounds the corner at the end of the move before it.
  Path& round_block(double radius, std::optional<Feed> own = {}) {
    blender.round_corner(next(), Length::mm(radius), own);
    return end_block();
  }
  Path& chamfer_block(double size, std::optional<Feed> own = {}) {
    blender.chamfer_corner(next(), Length::mm(size), Chamfer::Leg, own);
    return end_block();
  }
  Path& end() {
    blender.on_end({});
    return *this;
  }
  std::optional<FaultKind> fault() const {
    const auto& fault = blender.fault();
    return fault ? std::optional(fault->kind) : std::nullopt;
  }

  PathLog log;
  CornerBlender blender;
  Feed feed = Feed::per_minute(Length::mm(200));

 private:
  Origin next() {
    ++origin_.block;
    ++origin_.line;
    return origin_;
  }
  Path& end_block() {
    blender.on_block_end(origin_);
    return *this;
  }
  Position at_;
  Origin origin_;
};

/// A move as expected: an arc when it has a sweep, in degrees.
struct Expected {
  PlaneVector to;
  PlaneVector center = {};
  double sweep = 0;
};

inline void expect_moves(const PathLog& log, const std::vector<Expected>& expected) {
  ASSERT_EQ(log.moves.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Move& move = log.moves[i];
    EXPECT_NEAR(move.to.first, expected[i].to.first, 1e-9) << "move " << i;
    EXPECT_NEAR(move.to.second, expected[i].to.second, 1e-9) << "move " << i;
    EXPECT_EQ(move.kind == Move::Kind::Arc, expected[i].sweep != 0) << "move " << i;
    if (expected[i].sweep == 0) continue;
    EXPECT_NEAR(move.center.first, expected[i].center.first, 1e-9) << "move " << i;
    EXPECT_NEAR(move.center.second, expected[i].center.second, 1e-9) << "move " << i;
    EXPECT_NEAR(Angle::radians(move.sweep).degrees(), expected[i].sweep, 1e-7) << "move " << i;
  }
}

}  // namespace dripline::interpreter::blending
