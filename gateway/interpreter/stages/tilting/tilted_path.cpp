#include "gateway/interpreter/stages/tilting/tilted_path.hpp"

#include <fmt/core.h>

#include "gateway/interpreter/core/geometry/arc_point.hpp"
#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/core/path_feed.hpp"

namespace dripline::interpreter::tilting {
namespace {

constexpr int kMaxTiltedPieces = 20'000;  ///< of one move
constexpr double kNoMove = 1e-9;          ///< what going there and back leaves of a place
constexpr double kSamePlace = 1e-6;       ///< of an arc's start
constexpr double kParallel = 1e-9;        ///< of a plane and one of the machine's
constexpr double kLongestArcPiece = 5;    ///< of an arc in straight pieces, degrees

void set_linear(Position& at, const Point3& to) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Axis>(i);
    if (std::fabs(to[i] - at.raw(axis)) > kNoMove) at.set_raw(axis, to[i]);
  }
}

/// All axes by the same part.
Position between(const Position& from, const Position& to, double part) {
  Position at = to;
  for (const Axis axis : kAllAxes) {
    const double travel = to.raw(axis) - from.raw(axis);
    if (travel != 0) at.set_raw(axis, from.raw(axis) + part * travel);
  }
  return at;
}

/// Of an arc whose chords are off it by no more than the tolerance.
int pieces_of_arc(double radius, double sweep, double tolerance) {
  const double cosine = 1 - tolerance / std::max(radius, tolerance);
  const double piece = std::min(2 * std::acos(cosine) * (180 / Angle::kPi), kLongestArcPiece);
  return std::clamp(static_cast<int>(std::ceil(std::min(sweep / piece, 1e6) - 1e-9)), 1,
                    kMaxTiltedPieces);
}

/// The feed of a piece, so that all of them together take `minutes`.
void set_feed(Line& piece, const Line& whole, int pieces, double minutes) {
  const Feed& feed = whole.feed;
  if (feed.per() == Feed::Per::Move) {
    piece.feed = Feed::inverse_time(feed.moves_per_minute() * pieces);
  } else if (feed.per() == Feed::Per::Minute && minutes > 0) {
    piece.feed = Feed::inverse_time(pieces / minutes);
  }
}

}  // namespace

void TiltedPath::begin(const Tilt& tilt, const Position& machine) {
  state_.tilt = tilt;
  state_.machine = machine;
  state_.flat = flat_of(machine);
}

Position TiltedPath::on_machine(const Position& flat) const {
  const Tilt& tilt = state_.tilt;
  const Kinematics& machine = rules_.kinematics();
  const Pose pose = pose_of(machine, flat);
  const Point3 work = tilt.at + tilt.frame * (linear_of(flat) - tilt.flat_zero);
  const Point3 tip = table_motion(machine, pose)(table_motion(machine, tilt.zero).inverse()(work));
  Position to = state_.machine;
  for (const Axis axis : kAllAxes) {
    if (axis < Axis::A) continue;
    if (flat.has(axis)) to.set_raw(axis, flat.raw(axis));
  }
  set_linear(to, tip - tip_shift(machine, pose, tilt.length));
  return to;
}

Position TiltedPath::flat_of(const Position& at) const {
  const Tilt& tilt = state_.tilt;
  const Kinematics& machine = rules_.kinematics();
  const Pose pose = pose_of(machine, at);
  const Point3 tip = linear_of(at) + tip_shift(machine, pose, tilt.length);
  const Point3 work = table_motion(machine, tilt.zero)(table_motion(machine, pose).inverse()(tip));
  Position flat = at;
  set_linear(flat, tilt.flat_zero + transposed(tilt.frame) * (work - tilt.at));
  return flat;
}

std::optional<Pose> TiltedPath::pose_for(const Point3& direction) const {
  const Kinematics& machine = rules_.kinematics();
  return aligned_pose(machine, state_.tilt.zero, state_.tilt.frame * direction,
                      pose_of(machine, state_.machine));
}

bool TiltedPath::check(const Origin& origin, const Position& from, const Position& to) {
  const Units units = state_.tilt.mm_per_unit == 1 ? Units::Millimeter : Units::Inch;
  std::string text = rules_.travel_fault(from, to, units);
  if (text.empty()) return true;
  fault_ = Fault{true, origin, std::move(text)};
  return false;
}

bool TiltedPath::check_pieces(const Origin& origin, const Position& to, int pieces) {
  if (!rules_.checks_travel()) return true;
  Position last = state_.machine;
  for (int n = 1; n <= pieces; ++n) {
    const double part = static_cast<double>(n) / pieces;
    const Position next = on_machine(n == pieces ? to : between(state_.flat, to, part));
    if (!check(origin, last, next)) return false;
    last = next;
  }
  return true;
}

/// More than kMaxTiltedPieces: too many.
int TiltedPath::pieces_of(const Position& to) const {
  const Kinematics& machine = rules_.kinematics();
  const Rigid back = table_motion(machine, state_.tilt.zero).inverse();
  const Tilt& tilt = state_.tilt;
  const auto on_table = [&](const Position& flat) {
    return back(tilt.at + tilt.frame * (linear_of(flat) - tilt.flat_zero));
  };
  const double pieces = pieces_within(machine, pose_of(machine, state_.flat), pose_of(machine, to),
                                      on_table(state_.flat), on_table(to), tilt.length);
  return pieces <= kMaxTiltedPieces ? static_cast<int>(pieces) : kMaxTiltedPieces + 1;
}

/// Per revolution of a move of the machine's axes that takes so many.
Feed TiltedPath::feed_within(double revolutions, const Position& to) const {
  const AxisTravel travel = travel_between(state_.machine, to);
  const double length = travel.linear != 0 ? travel.linear : travel.rotary;
  return Feed::per_revolution(Length::mm(length / revolutions));
}

/// F is the speed of the tip, or of the rotary axes where it rests. Of a feed per revolution these
/// are revolutions.
double TiltedPath::minutes_of(const Line& line) const {
  const Kinematics& machine = rules_.kinematics();
  const double path = length(linear_of(line.to) - linear_of(state_.flat));
  const double speed = line.feed.length().mm();
  if (path > kSamePlace) return path / speed;
  const Pose from = pose_of(machine, state_.flat);
  const Pose to = pose_of(machine, line.to);
  return std::hypot(to.master - from.master, to.slave - from.slave) * state_.tilt.mm_per_unit /
         speed;
}

template <class Event>
void TiltedPath::deliver_straight(const Event& whole, void (EventSink::*deliver)(const Event&)) {
  if (fault_) return;
  const int pieces = pieces_of(whole.to);
  if (pieces > kMaxTiltedPieces) {
    fault_ = Fault{false, whole.origin,
                   fmt::format("the tip's path within {} mm takes more than {} pieces",
                               rules_.kinematics().tip_tolerance, kMaxTiltedPieces)};
    return;
  }
  if (!check_pieces(whole.origin, whole.to, pieces)) return;
  const Position from = state_.flat;
  const Pose pose = pose_of(rules_.kinematics(), from);
  const Pose end = pose_of(rules_.kinematics(), whole.to);
  const bool rotates =
      std::fabs(end.master - pose.master) > kNoMove || std::fabs(end.slave - pose.slave) > kNoMove;
  Event piece = whole;
  double revolutions = 0;
  if constexpr (std::is_same_v<Event, Line>) {
    const bool is_timed = rotates && whole.feed.per() == Feed::Per::Minute;
    set_feed(piece, whole, pieces, is_timed ? minutes_of(whole) : 0);
    if (rotates && whole.feed.per() == Feed::Per::Revolution) revolutions = minutes_of(whole);
  }
  for (int n = 1; n <= pieces; ++n) {
    const double part = static_cast<double>(n) / pieces;
    piece.to = on_machine(n == pieces ? whole.to : between(from, whole.to, part));
    piece.rests = whole.rests && n == pieces;
    if constexpr (std::is_same_v<Event, Line>) {
      if (revolutions > 0) piece.feed = feed_within(revolutions / pieces, piece.to);
    }
    (out().*deliver)(piece);
    state_.machine = piece.to;
  }
  state_.flat = whole.to;
}

/// F of a move of the machine's axes.
Feed TiltedPath::feed_of_axes(const Feed& feed, const Position& to) const {
  return feed_of_all_axes(feed, travel_between(state_.machine, to),
                          Length::mm(state_.tilt.mm_per_unit));
}

void TiltedPath::turn_to(const Origin& origin, Pose pose, const std::optional<Feed>& feed,
                         bool rests) {
  Position to = state_.machine;
  const auto set = [&to](const RotaryAxis& rotary, double degrees) {
    if (std::fabs(degrees - to.raw(rotary.axis)) > kNoMove) to.set_raw(rotary.axis, degrees);
  };
  set(rules_.kinematics().master, pose.master);
  set(rules_.kinematics().slave, pose.slave);
  if (to.same_point(state_.machine) ||
      (rules_.checks_travel() && !check(origin, state_.machine, to)))
    return;
  if (feed) {
    out().on_line({origin, to, feed_of_axes(*feed, to), rests});
  } else {
    out().on_rapid({origin, to});
  }
  state_.machine = to;
  state_.flat = flat_of(to);
}

bool TiltedPath::lags() const {
  const Position start = on_machine(state_.flat);
  return length(linear_of(start) - linear_of(state_.machine)) > kSamePlace;
}

void TiltedPath::take_length(const Origin& origin, const std::optional<Feed>& feed, bool rests) {
  if (feed) return deliver_straight(Line{origin, state_.flat, *feed, rests}, &EventSink::on_line);
  deliver_straight(Rapid{origin, state_.flat}, &EventSink::on_rapid);
}

void TiltedPath::place(const Position& machine, double mm_per_unit) {
  state_.machine = machine;
  state_.tilt.mm_per_unit = mm_per_unit;
}

/// Of the machine's axes already.
template <class Event>
void TiltedPath::deliver_checked(const Event& event, void (EventSink::*deliver)(const Event&)) {
  if (fault_) return;
  if constexpr (std::is_same_v<Event, Arc>) {
    if (!check_arc(event)) return;
  } else {
    if (rules_.checks_travel() && !check(event.origin, state_.machine, event.to)) return;
  }
  (out().*deliver)(event);
  state_.machine = event.to;
}

/// Never in these modes.
void TiltedPath::on_probe(const Probe& event) {
  if (event.result) state_.machine = event.result->at;
  out().on_probe(event);
}

void TiltedPath::on_units(const UnitsChange& event) {
  state_.tilt.mm_per_unit = event.units == Units::Inch ? Length::kMillimetersPerInch : 1;
  out().on_units(event);
}

/// A program with a move that was not made ends with its alarm.
void TiltedPath::on_end(const End& event) {
  if (!fault_) out().on_end(event);
}

void TiltedPath::on_rapid(const Rapid& event) {
  if (!is_on()) return deliver_checked(event, &EventSink::on_rapid);
  deliver_straight(event, &EventSink::on_rapid);
}

void TiltedPath::on_line(const Line& event) {
  if (is_on()) return deliver_straight(event, &EventSink::on_line);
  Line line = event;
  if (rules_.sets_axis_feeds()) line.feed = feed_of_axes(event.feed, event.to);
  deliver_checked(line, &EventSink::on_line);
}

/// A rigid tap: as long as it was, along whatever axes.
void TiltedPath::on_thread(const Thread& event) {
  if (!is_on()) return deliver_checked(event, &EventSink::on_thread);
  if (fault_) return;
  Thread thread = event;
  thread.to = on_machine(event.to);
  if (rules_.checks_travel() && !check(event.origin, state_.machine, thread.to)) return;
  out().on_thread(thread);
  state_.machine = thread.to;
  state_.flat = event.to;
}

/// From the axes of the moves that come in to the machine's.
Matrix3 TiltedPath::turn_now() const {
  const Kinematics& machine = rules_.kinematics();
  const Pose pose = pose_of(machine, state_.flat);
  return table_motion(machine, pose).turn *
         transposed(table_motion(machine, state_.tilt.zero).turn) * state_.tilt.frame;
}

/// False: its plane is none of the machine's.
bool TiltedPath::arc_on_machine(const Arc& flat, Arc& arc) const {
  const PlaneAxes axes = axes_of(flat.plane);
  const Point3 normal = turn_now().column(static_cast<std::size_t>(axes.normal));
  const auto largest = std::max_element(
      normal.begin(), normal.end(), [](double a, double b) { return std::fabs(a) < std::fabs(b); });
  const auto across = static_cast<std::size_t>(largest - normal.begin());
  for (std::size_t i = 0; i < 3; ++i) {
    if (i != across && std::fabs(normal[i]) > kParallel) return false;
  }
  Position center = state_.flat;
  center.set_raw(axes.first, flat.center_first.mm());
  center.set_raw(axes.second, flat.center_second.mm());
  const Position middle = on_machine(center);
  arc = flat;
  arc.to = on_machine(flat.to);
  arc.plane = plane_across(static_cast<Axis>(across));
  const PlaneAxes on = axes_of(arc.plane);
  arc.center_first = Length::mm(middle.raw(on.first));
  arc.center_second = Length::mm(middle.raw(on.second));
  if (*largest < 0)
    arc.turn = flat.turn == Turn::Clockwise ? Turn::Counterclockwise : Turn::Clockwise;
  return true;
}

bool TiltedPath::check_arc(const Arc& arc) {
  if (!rules_.checks_travel()) return true;
  const int pieces = static_cast<int>(std::ceil(arc.sweep.degrees() / kLongestArcPiece));
  Position last = state_.machine;
  for (int n = 1; n <= pieces; ++n) {
    const Position next = point_on_arc(arc, state_.machine, arc.sweep.degrees() * n / pieces);
    if (!check(arc.origin, last, next)) return false;
    last = next;
  }
  return true;
}

void TiltedPath::deliver_pieces_of_arc(const Arc& arc) {
  const Position from = state_.flat;
  const PlaneAxes axes = axes_of(arc.plane);
  const double radius = std::hypot(from.raw(axes.first) - arc.center_first.mm(),
                                   from.raw(axes.second) - arc.center_second.mm());
  const int pieces = pieces_of_arc(radius, arc.sweep.degrees(), rules_.kinematics().tip_tolerance);
  const auto point = [&](int n) {
    return on_machine(n == pieces ? arc.to
                                  : point_on_arc(arc, from, arc.sweep.degrees() * n / pieces));
  };
  Position last = state_.machine;
  for (int n = 1; rules_.checks_travel() && n <= pieces; ++n) {
    const Position next = point(n);
    if (!check(arc.origin, last, next)) return;
    last = next;
  }
  Line piece{arc.origin, {}, arc.feed};
  set_feed(piece, piece, pieces, 0);
  for (int n = 1; n <= pieces; ++n) {
    piece.to = point(n);
    piece.rests = arc.rests && n == pieces;
    out().on_line(piece);
    state_.machine = piece.to;
  }
  state_.flat = arc.to;
}

void TiltedPath::on_arc(const Arc& programmed) {
  Arc event = programmed;
  const Position& from = is_on() ? state_.flat : state_.machine;
  if (!rules_.helix_feed_is_path()) event.feed = feed_along_circle(event.feed, event, from);
  if (!is_on()) return deliver_checked(event, &EventSink::on_arc);
  if (fault_) return;
  // A length that came into force since the last move is compensated before the arc.
  if (lags()) take_length(event.origin, event.feed, false);
  if (fault_) return;
  Arc arc;
  if (!arc_on_machine(event, arc)) return deliver_pieces_of_arc(event);
  if (!check_arc(arc)) return;
  out().on_arc(arc);
  state_.machine = arc.to;
  state_.flat = event.to;
}

}  // namespace dripline::interpreter::tilting
