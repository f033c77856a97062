#include "gateway/interpreter/dialects/tnc155/execution/path.hpp"

#include <bit>
#include <cmath>

#include "gateway/interpreter/core/path_feed.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

constexpr AxisMask kRotary = bit(Axis::A) | bit(Axis::B) | bit(Axis::C);
/// Rotated coordinates nearer to the old ones than this have not changed.
constexpr double kSame = 1e-9;

/// Of the linear axes, or of a rotary axis that moves alone, as the machine wants it.
double feed_with_rotary(const Run& run, const Position& to, const Pace& pace) {
  const AxisTravel travel = travel_between(run.state.machine, to);
  if (run.tilted.kind() == tilting::Tilt::Kind::TipControl)  // F is the tip's speed
    return travel.linear == 0 ? pace.rotary_feed * run.state.mm_per_unit() : pace.feed;
  if (travel.rotary == 0) return pace.feed;
  if (travel.linear == 0) return pace.rotary_feed;
  if (!run.options.contour_feed) return pace.rotary_feed * travel.linear / travel.rotary;
  const Feed feed = Feed::per_minute(Length::mm(pace.feed));
  return feed_of_all_axes(feed, travel, Length::mm(1)).length().mm();
}

Feed feed_to(const Run& run, const Target& target, const Position& to, const Pace& pace) {
  const bool is_rotating = (target.named & kRotary) != 0 && !pace.is_rapid;
  return Feed::per_minute(Length::mm(is_rotating ? feed_with_rotary(run, to, pace) : pace.feed));
}

void output(Run& run, const Line& move, bool is_rapid) {
  State& state = run.state;
  const bool moves = !move.to.same_point(state.machine);
  if (moves) run.loops.note_progress();
  if (run.is_measuring) [[unlikely]] {
    run.limits.check_line(move.origin, state.machine, move.to);
  } else if (moves && is_rapid) {
    run.events().on_rapid({move.origin, move.to});
  } else if (moves) {
    run.events().on_line(move);
  }
  state.machine = move.to;
}

void apply(const State& state, Position& to, const Target& target) {
  if (!state.transformation.is_special) [[likely]] {
    for (unsigned left = target.named; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      const auto axis = static_cast<Axis>(i);
      to.set_raw(axis, state.transformation.to_machine(axis, target.at[i]));
    }
    return;
  }
  const AxisValues at = state.transformation.to_machine(target.at);
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const auto axis = static_cast<Axis>(i);
    const bool is_named = (target.named & bit(axis)) != 0;
    const bool follows = axis <= Axis::Z && std::fabs(at[i] - to.raw(axis)) > kSame;
    if (is_named || follows) to.set_raw(axis, at[i]);
  }
}

/// The previous element stays where it is in the machine; CT, which continues it, needs it in the
/// new coordinates.
void carry_last_move(State& state, const Transformation& before, const AxisValues& nominal) {
  const PlaneAxes axes = axes_of(state.plane);
  const auto first = static_cast<std::size_t>(axes.first);
  const auto second = static_cast<std::size_t>(axes.second);
  LastMove& last = state.last;
  for (PlaneVector* point : {&last.from, &last.to, &last.center}) {
    AxisValues at = nominal;
    at[first] = point->first;
    at[second] = point->second;
    at = state.transformation.to_program(before.to_machine(at));
    *point = {at[first], at[second]};
  }
  if (before.turns_over(state.plane) == state.transformation.turns_over(state.plane)) return;
  last.turn = last.turn == Turn::Clockwise ? Turn::Counterclockwise : Turn::Clockwise;
}

}  // namespace

void arrive(State& state, const Target& target) {
  if (!state.is_beside) [[likely]] {
    state.nominal = target.at;
    return;
  }
  state.is_beside = false;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    if ((target.named >> i & 1u) != 0) {
      state.nominal[i] = target.at[i];
      state.beside[i] = 0;
    }
    state.is_beside = state.is_beside || state.beside[i] != 0;
  }
}

PlaneVector nominal_in_plane(const State& state) {
  const PlaneAxes axes = axes_of(state.plane);
  return {state.nominal_of(axes.first), state.nominal_of(axes.second)};
}

Position machine_position(const State& state, const Target& target) {
  Position to = state.machine;
  apply(state, to, target);
  return to;
}

void line_to(Run& run, const Target& target, const Pace& pace) {
  State& state = run.state;
  Line move{run.origin, state.machine, {}};
  apply(state, move.to, target);
  arrive(state, target);
  move.feed = feed_to(run, target, move.to, pace);
  output(run, move, pace.is_rapid);
}

void arc_to(Run& run, const ArcTarget& target, const Pace& pace) {
  State& state = run.state;
  const PlaneAxes axes = axes_of(state.plane);
  Arc arc;
  arc.origin = run.origin;
  arc.to = machine_position(state, target.to);
  AxisValues center = state.nominal;
  center[static_cast<std::size_t>(axes.first)] = target.center.first;
  center[static_cast<std::size_t>(axes.second)] = target.center.second;
  center = state.transformation.to_machine(center);
  arc.center_first = Length::mm(center[static_cast<std::size_t>(axes.first)]);
  arc.center_second = Length::mm(center[static_cast<std::size_t>(axes.second)]);
  arc.plane = state.plane;
  const bool turns_over = state.transformation.turns_over(state.plane);
  arc.turn =
      (target.turn == Turn::Clockwise) != turns_over ? Turn::Clockwise : Turn::Counterclockwise;
  arc.sweep = Angle::degrees(target.sweep);
  arc.feed = Feed::per_minute(Length::mm(pace.is_rapid ? kFeedAtRapid : pace.feed));
  if (run.is_measuring) [[unlikely]] {
    run.limits.check_arc(arc, state.machine);
  } else {
    run.loops.note_progress();
    run.events().on_arc(arc);
  }
  state.machine = arc.to;
  arrive(state, target.to);
}

void machine_line_to(Run& run, const Target& target, const Pace& pace) {
  State& state = run.state;
  Line move{run.origin, state.machine, {}};
  Position& to = move.to;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const auto axis = static_cast<Axis>(i);
    if ((target.named & bit(axis)) != 0) to.set_raw(axis, target.at[i]);
  }
  move.feed = feed_to(run, target, to, pace);
  output(run, move, pace.is_rapid);
  const AxisValues nominal = state.transformation.to_program(values_of(to));
  if (state.transformation.is_special) return state.stand_at(nominal);
  Target reached{state.nominal, target.named};
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    if ((target.named >> i & 1u) != 0) reached.at[i] = nominal[i];
  }
  arrive(state, reached);
}

void change_transformation(Run& run, const Transformation& changed) {
  State& state = run.state;
  const Transformation before = state.transformation;
  const AxisValues nominal = state.nominal, tool = state.tool_position();
  state.transformation = changed;
  state.transformation.update();
  state.nominal = state.transformation.to_program(before.to_machine(nominal));
  if (state.is_beside) {
    const AxisValues now = state.transformation.to_program(before.to_machine(tool));
    for (std::size_t i = 0; i < kAxisCount; ++i) {
      const double by = now[i] - state.nominal[i];
      state.beside[i] = std::fabs(by) > kSame ? by : 0;
    }
  }
  carry_last_move(state, before, nominal);
  state.polar.is_current = false;
  ++run.frame_changes;
}

}  // namespace dripline::interpreter::tnc155
