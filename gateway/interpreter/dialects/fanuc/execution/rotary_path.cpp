#include "gateway/interpreter/dialects/fanuc/execution/rotary_path.hpp"

#include <algorithm>
#include <cmath>

#include "gateway/interpreter/core/geometry/arc_point.hpp"
#include "gateway/interpreter/core/path_feed.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"

namespace dripline::interpreter::fanuc {
namespace {

constexpr double kDegreesPerRadian = 180 / Angle::kPi;
constexpr double kPathTolerance = 0.001;    ///< of a piece, millimeters
constexpr double kLongestRotaryPiece = 5;   ///< degrees of the rotary axis, or of an arc
constexpr double kClosestToCenter = 0.001;  ///< millimeters
constexpr int kMaxRotaryPieces = 20'000;

/// The angle of a piece whose middle is off its circle by the tolerance.
double piece_degrees(double radius) {
  const double cosine = 1 - kPathTolerance / std::max(radius, kPathTolerance);
  return std::clamp(2 * std::acos(cosine) * kDegreesPerRadian, 0.05, kLongestRotaryPiece);
}

int pieces_for(double degrees, double piece) {
  return std::clamp(static_cast<int>(std::ceil(std::fabs(degrees) / piece - 1e-9)), 1,
                    kMaxRotaryPieces);
}

}  // namespace

void RotaryPath::begin(const RotaryPlane& plane, const Position& at) {
  state_ = {plane, at, plane.start_degrees, false};
}

void RotaryPath::end() {
  state_.plane.kind = RotaryPlane::Kind::None;
}

/// The rotary axis rotates in the shorter direction.
Position RotaryPath::on_machine(const Position& flat) {
  const RotaryPlane& plane = state_.plane;
  const double across = flat.raw(plane.slot) - plane.zero_slot;
  Position to = flat;
  to.set_raw(plane.slot, plane.held);
  if (!plane.slot_has_moved) to.unmark(plane.slot);
  if (plane.kind == RotaryPlane::Kind::Cylinder) {
    state_.degrees = plane.start_degrees + across / plane.radius * kDegreesPerRadian;
  } else {
    const double along = flat.raw(plane.partner) - plane.zero_partner;
    const double distance = std::hypot(along, across);
    if (distance < kClosestToCenter) state_.has_fault = true;
    const double degrees = plane.start_degrees + std::atan2(across, along) * kDegreesPerRadian;
    state_.degrees += std::remainder(degrees - state_.degrees, 360);
    to.set_raw(plane.partner, plane.zero_partner + distance);
  }
  to.set_raw(plane.rotary, state_.degrees);
  return to;
}

/// All pieces together take the time of the whole move.
template <class PointAt>
void RotaryPath::deliver(const Line& whole, double length, int pieces, PointAt point_at) {
  Line piece = whole;
  const Feed& feed = whole.feed;
  if (feed.per() == Feed::Per::Minute && length > 0) {
    piece.feed = Feed::inverse_time(feed.length().mm() / length * pieces);
  } else if (feed.per() == Feed::Per::Move) {
    piece.feed = Feed::inverse_time(feed.moves_per_minute() * pieces);
  }
  for (int n = 1; n <= pieces && !state_.has_fault; ++n) {
    piece.to = on_machine(n == pieces ? whole.to : point_at(static_cast<double>(n) / pieces));
    piece.rests = whole.rests && n == pieces;
    if (!state_.has_fault) out().on_line(piece);
  }
  state_.at = whole.to;
}

int RotaryPath::pieces_of_line(const Position& to) const {
  const RotaryPlane& plane = state_.plane;
  if (plane.kind == RotaryPlane::Kind::Cylinder) return 1;
  const PlaneVector zero{plane.zero_partner, plane.zero_slot};
  const PlaneVector from =
      PlaneVector{state_.at.raw(plane.partner), state_.at.raw(plane.slot)} - zero;
  const PlaneVector end = PlaneVector{to.raw(plane.partner), to.raw(plane.slot)} - zero;
  const PlaneVector along = end - from;
  const double size = dripline::interpreter::length(along);
  if (size == 0) return 1;
  // Near the center the axis rotates fast: the pieces are as short as they have to be there.
  const double closest_at = std::clamp(-dot(from, along) / (size * size), 0.0, 1.0);
  const double closest = dripline::interpreter::length(from + closest_at * along);
  if (closest < kClosestToCenter) return kMaxRotaryPieces;
  const double far =
      std::max(dripline::interpreter::length(from), dripline::interpreter::length(end));
  const double piece = closest * piece_degrees(far) / kDegreesPerRadian;
  const double turn = std::acos(std::clamp(
      dot(from, end) / (dripline::interpreter::length(from) * dripline::interpreter::length(end)),
      -1.0, 1.0));
  if (turn * kDegreesPerRadian < 1e-9) return 1;
  return std::clamp(static_cast<int>(std::ceil(size / piece)), 1, kMaxRotaryPieces);
}

void RotaryPath::on_rapid(const Rapid& event) {
  if (!is_on()) return out().on_rapid(event);
  Rapid move = event;
  move.to = on_machine(event.to);
  state_.at = event.to;
  if (!state_.has_fault) out().on_rapid(move);
}

void RotaryPath::on_line(const Line& event) {
  if (!is_on()) return out().on_line(event);
  const Position from = state_.at;
  double square = 0;
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
    const double travel = event.to.raw(axis) - from.raw(axis);
    square += travel * travel;
  }
  deliver(event, std::sqrt(square), pieces_of_line(event.to), [&](double part) {
    Position point = event.to;
    for (const Axis axis : kAllAxes) {
      const double travel = event.to.raw(axis) - from.raw(axis);
      if (travel != 0) point.set_raw(axis, from.raw(axis) + part * travel);
    }
    return point;
  });
}

void RotaryPath::on_arc(const Arc& event) {
  if (!is_on()) return out().on_arc(event);
  const Position from = state_.at;
  const Feed feed = helix_feed_is_path_ ? event.feed : feed_along_circle(event.feed, event, from);
  const PlaneAxes axes = axes_of(event.plane);
  const double radius = std::hypot(from.raw(axes.first) - event.center_first.mm(),
                                   from.raw(axes.second) - event.center_second.mm());
  const double height = event.to.raw(axes.normal) - from.raw(axes.normal);
  const double length = std::hypot(radius * event.sweep.radians(), height);
  int pieces = pieces_for(event.sweep.degrees(), piece_degrees(radius));
  if (state_.plane.kind == RotaryPlane::Kind::Polar) pieces *= 2;
  deliver({event.origin, event.to, feed, event.rests}, length, pieces,
          [&](double part) { return point_on_arc(event, from, event.sweep.degrees() * part); });
}

}  // namespace dripline::interpreter::fanuc
