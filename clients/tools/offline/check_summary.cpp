#include "clients/tools/offline/check_summary.hpp"

#include <algorithm>
#include <cmath>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::interpreter {

namespace {

/// Over the linear axes; a move of rotary axes alone takes its degrees as millimeters, which is
/// how controls read the feed of such a move.
Length distance(const Position& from, const Position& to) {
  const auto square = [&](Axis axis) {
    const double delta = to.raw(axis) - from.raw(axis);
    return delta * delta;
  };
  const double linear = square(Axis::X) + square(Axis::Y) + square(Axis::Z) + square(Axis::U) +
                        square(Axis::V) + square(Axis::W);
  if (linear > 0) return Length::mm(std::sqrt(linear));
  return Length::mm(std::sqrt(square(Axis::A) + square(Axis::B) + square(Axis::C)));
}

}  // namespace

CheckSummary::CheckSummary(const Position& start, CheckRates rates, const MachineData& machine)
    : rates_(rates), last_(start) {
  summary_.has_acceleration = MotionClock::is_stated(machine);
  if (!summary_.has_acceleration) return;
  clock_ = std::make_unique<MotionClock>(
      machine, [this](std::uint64_t block, double seconds) { add_seconds(block, seconds); });
}

void CheckSummary::add_seconds(std::uint64_t block, double seconds) {
  summary_.seconds += seconds;
  if (on_timed_) on_timed_(block, seconds);
}

void CheckSummary::rest() {
  if (clock_) clock_->stop();
}

std::uint64_t CheckSummary::first_open() const {
  return clock_ ? std::min(clock_->first_open(), ended_blocks_) : ended_blocks_;
}

inline void CheckSummary::extend(Axis axis, double value) {
  auto& extent = summary_.extents[static_cast<std::size_t>(axis)];
  if (!extent) [[unlikely]] {
    extent = AxisExtent{value, value};
  } else if (value < extent->least) {
    extent->least = value;
  } else if (value > extent->most) {
    extent->most = value;
  }
}

/// Every move comes here: unrolled, an axis that has not moved costs one test of a bit.
template <std::size_t... kIndexes>
inline void CheckSummary::extend_to(const Position& to, std::index_sequence<kIndexes...> /*axes*/) {
  const auto extend_one = [&](Axis axis) {
    if (to.has(axis)) extend(axis, to.raw(axis));
  };
  (extend_one(kAllAxes[kIndexes]), ...);
}

void CheckSummary::move_to(const Position& to) {
  ++summary_.moves;
  extend_to(to, std::make_index_sequence<kAxisCount>{});
  last_ = to;
}

double CheckSummary::spindle_speed() const {
  double speed = spindle_.revolutions_per_minute;
  if (spindle_.surface_speed) {
    const Length around = 2 * Angle::kPi * abs(last_.linear(Axis::X));
    speed = around > Length{} ? *spindle_.surface_speed / around : 0;
    if (spindle_.max_revolutions && (speed == 0 || speed > *spindle_.max_revolutions)) {
      speed = *spindle_.max_revolutions;
    }
  }
  return speed > 0 ? speed : rates_.spindle_speed;
}

void CheckSummary::cut(const Stretch& stretch, const Feed& feed) {
  summary_.feed_length += stretch.length;
  double per_minute = 0;  // moves, or millimeters
  double amount = stretch.length.mm();
  switch (feed.per()) {
    case Feed::Per::Minute:
      per_minute = feed.length().mm();
      break;
    case Feed::Per::Revolution:
      per_minute = feed.length().mm() * spindle_speed();
      break;
    case Feed::Per::Move:
      per_minute = feed.moves_per_minute();
      amount = 1;
      break;
  }
  if (per_minute > 0) pass(stretch, kSecondsPerMinute * amount / per_minute);
}

void CheckSummary::pass(const Stretch& stretch, double nominal_seconds) {
  if (!clock_) return add_seconds(ended_blocks_, nominal_seconds);
  TimedMove move = timed(stretch);
  if (nominal_seconds > 0) move.speed = move.length / nominal_seconds;
  move.is_rapid = stretch.is_rapid;
  clock_->add(move);
  if (stretch.rests) clock_->stop();
}

/// Changes of the axes for one unit of the length that the feed is for.
TimedMove CheckSummary::timed(const Stretch& stretch) const {
  TimedMove move;
  move.tag = ended_blocks_;
  move.length = stretch.length.mm();
  if (!(move.length > 0)) return move;
  for (const Axis axis : kAllAxes) {
    const auto i = static_cast<std::size_t>(axis);
    move.begins[i] = move.ends[i] = (stretch.to.raw(axis) - last_.raw(axis)) / move.length;
    move.share[i] = std::fabs(move.begins[i]);
  }
  if (stretch.arc == nullptr) return move;
  const Arc& arc = *stretch.arc;
  const PlaneAxes axes = axes_of(arc.plane);
  move.first = axes.first;
  move.second = axes.second;
  const auto first = static_cast<std::size_t>(axes.first);
  const auto second = static_cast<std::size_t>(axes.second);
  const double sense = arc.turn == Turn::Counterclockwise ? 1 : -1;
  // A tangent is the radius, turned by a quarter and as long as the circle's part of the path.
  const auto tangent = [&](const Position& at, TimedMove::Coordinates& direction) {
    const double x = at.raw(axes.first) - arc.center_first.mm();
    const double y = at.raw(axes.second) - arc.center_second.mm();
    move.radius = std::hypot(x, y);
    const double share = arc.sweep.radians() / move.length;
    direction[first] = -sense * y * share;
    direction[second] = sense * x * share;
  };
  tangent(stretch.to, move.ends);
  tangent(last_, move.begins);
  move.share[first] = move.share[second] = move.radius * arc.sweep.radians() / move.length;
  return move;
}

void CheckSummary::on_program(const ProgramHeader& header) {
  summary_.control = header.control;
  if (header.name) summary_.program = std::string(*header.name);
  summary_.units = header.units;
  summary_.x_is_diameter = header.x_is_diameter;
}

void CheckSummary::on_rapid(const Rapid& rapid) {
  const Length length = distance(last_, rapid.to);
  summary_.rapid_length += length;
  if (rates_.rapid_per_minute > Length{}) {
    pass({.to = rapid.to, .length = length, .rests = rapid.rests, .is_rapid = true},
         kSecondsPerMinute * (length / rates_.rapid_per_minute));
  }
  move_to(rapid.to);
}

void CheckSummary::on_line(const Line& line) {
  cut({.to = line.to, .length = distance(last_, line.to), .rests = line.rests}, line.feed);
  move_to(line.to);
}

Length CheckSummary::radius_of(const Arc& arc) const {
  const PlaneAxes axes = axes_of(arc.plane);
  const PlaneVector center{arc.center_first.mm(), arc.center_second.mm()};
  return Length::mm(length(in_plane(last_, axes) - center));
}

/// Whether all of its circle lies between coordinates that were reached: nearly always, and much
/// quicker to see than which quarters the arc passes.
bool CheckSummary::has_reached(const Arc& arc, Length radius) const {
  const auto is_between = [&](Axis axis, Length center) {
    const auto& extent = summary_.extents[static_cast<std::size_t>(axis)];
    return extent && extent->least <= (center - radius).mm() &&
           (center + radius).mm() <= extent->most;
  };
  const PlaneAxes axes = axes_of(arc.plane);
  return is_between(axes.first, arc.center_first) && is_between(axes.second, arc.center_second);
}

/// An arc reaches beyond its ends where it passes a quarter of its circle.
void CheckSummary::extend_arc(const Arc& arc, Length radius) {
  if (has_reached(arc, radius)) return;
  constexpr double kFull = 360, kHalf = 180;
  const PlaneAxes axes = axes_of(arc.plane);
  const PlaneVector center{arc.center_first.mm(), arc.center_second.mm()};
  const PlaneVector start = in_plane(last_, axes) - center, end = in_plane(arc.to, axes) - center;
  const double sense = arc.turn == Turn::Counterclockwise ? 1 : -1, sweep = arc.sweep.degrees();
  // `after_start` and `before_end`: how far left of the start, and right of the end, seen from the
  // center. Written out for the four: in a loop their zeros and ones would be multiplied with.
  const auto passes = [&](double after_start, double before_end) {
    const bool is_after = sense * after_start >= 0, is_before = sense * before_end >= 0;
    return sweep >= kFull || (sweep < kHalf ? is_after && is_before : is_after || is_before);
  };
  if (passes(-start.second, end.second)) extend(axes.first, center.first + radius.mm());
  if (passes(start.first, -end.first)) extend(axes.second, center.second + radius.mm());
  if (passes(start.second, -end.second)) extend(axes.first, center.first - radius.mm());
  if (passes(-start.first, end.first)) extend(axes.second, center.second - radius.mm());
}

Length CheckSummary::length_of(const Arc& arc, Length radius) const {
  const Axis normal = axes_of(arc.plane).normal;
  const Length rise = arc.to.linear(normal) - last_.linear(normal);
  const Length turned = radius * arc.sweep.radians();
  return rise == Length{} ? turned : hypot(turned, rise);
}

void CheckSummary::on_arc(const Arc& arc) {
  const Length radius = radius_of(arc);
  extend_arc(arc, radius);
  cut({.to = arc.to, .length = length_of(arc, radius), .arc = &arc, .rests = arc.rests}, arc.feed);
  move_to(arc.to);
}

void CheckSummary::on_thread(const Thread& thread) {
  std::optional<Arc> arc;
  if (thread.arc) arc = arc_of(thread);
  const Length radius = arc ? radius_of(*arc) : Length{};
  if (arc) extend_arc(*arc, radius);
  const Length path = arc ? length_of(*arc, radius) : distance(last_, thread.to);
  cut({.to = thread.to, .length = path, .arc = arc ? &*arc : nullptr},
      Feed::per_revolution(mean_lead(thread, path)));
  move_to(thread.to);
}

void CheckSummary::on_dwell(const Dwell& dwell) {
  rest();
  add_seconds(ended_blocks_, dwell.revolutions
                                 ? kSecondsPerMinute * *dwell.revolutions / spindle_speed()
                                 : dwell.seconds);
}

void CheckSummary::on_tool(const ToolChange& change) {
  if (!change.is_preselection) rest();
}

void CheckSummary::on_spindle(const Spindle& spindle) {
  spindle_ = spindle;
}

void CheckSummary::on_probe(const Probe& probe) {
  if (!probe.result) return;
  rest();
  const Position& at = probe.result->at;
  if (probe.is_rapid) return on_rapid({probe.origin, at});
  if (probe.arc) return on_arc(arc_of(probe));
  cut({.to = at, .length = distance(last_, at), .rests = true}, probe.feed);
  move_to(at);
}

void CheckSummary::on_warning(const Warning& warning) {
  ++summary_.warning_count;
  if (summary_.warnings.size() < Summary::kMaxWarnings) {
    summary_.warnings.push_back(warning);
  }
}

void CheckSummary::on_alarm(const Alarm& alarm) {
  rest();
  summary_.alarm = alarm;
  summary_.ended = false;  // whatever a program before it on the tape has done
}

void CheckSummary::on_end(const End& end) {
  rest();
  summary_.ended = true;
  ++summary_.programs;
  summary_.blocks = end.blocks;
}

void CheckSummary::on_block_end(const Origin& origin) {
  summary_.blocks = std::max(summary_.blocks, origin.block);
  ++ended_blocks_;
}

void MachineState::on_line(const Line& event) {
  position_ = event.to;
  feed_ = event.feed;
}

void MachineState::on_arc(const Arc& event) {
  position_ = event.to;
  feed_ = event.feed;
}

void MachineState::on_tool(const ToolChange& event) {
  if (!event.is_preselection) tool_ = event.number;
}

void MachineState::on_probe(const Probe& event) {
  if (event.result) position_ = event.result->at;
}

void StopList::on_stop(const Stop& event) {
  ++count_;
  const auto place = std::tuple(event.origin.program, event.origin.offset, event.kind);
  if (const auto known = known_.find(place); known != known_.end()) {
    ++places_[known->second].times;
  } else if (places_.size() < kMaxPlaces) {
    known_.emplace(place, places_.size());
    places_.push_back({event, 1});
  }
}

}  // namespace dripline::interpreter
