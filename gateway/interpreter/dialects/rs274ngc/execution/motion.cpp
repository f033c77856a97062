#include "gateway/interpreter/dialects/rs274ngc/execution/motion.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/dialects/rs274ngc/compensation/compensation.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/coordinates.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

constexpr std::array kRotaryAxes{Axis::A, Axis::B, Axis::C};
constexpr AddressSet kRareAxisWords = set_of("ABCUVW");

/// The point the words count from: with compensation on that of the programmed path.
void begin_at_base(const Run& run, Axes& to) {
  to = run.state.position;
  const Compensation& compensation = run.state.compensation;
  if (compensation.side != Side::Off && !compensation.is_first) [[unlikely]] {
    const PlaneAxes plane = axes_of(run.state.modes.plane);
    to[index_of(plane.first)] = compensation.x;
    to[index_of(plane.second)] = compensation.y;
  }
}

void take_axis(Target& target, Axis axis, double value, bool is_incremental) {
  double& coordinate = target.to[index_of(axis)];
  coordinate = is_incremental ? coordinate + value : value;
  target.named = static_cast<AxisBits>(target.named | bit_of(axis));
}

void read_rare_axes(const Run& run, Target& target, bool is_incremental) {
  const Words& words = run.block.words;
  for (const Axis axis : kRotaryAxes) {
    const char word = letter(axis);
    if (words.has(word)) take_axis(target, axis, words[word], is_incremental);
  }
  for (const Axis axis : {Axis::U, Axis::V, Axis::W}) {
    const char word = letter(axis);
    if (words.has(word)) take_axis(target, axis, run.mm(words[word]), is_incremental);
  }
}

/// @ and ^: distance and angle of the end point about the origin.
bool read_polar(Run& run, Target& target) {
  if (!check_polar_words(run)) return false;
  const Words& words = run.block.words;
  double& x = target.to[index_of(Axis::X)];
  double& y = target.to[index_of(Axis::Y)];
  double radius = std::hypot(x, y);
  double angle = std::atan2(y, x);
  const bool adds = run.state.modes.is_incremental;
  // There the present angle, from which both words go on, is any.
  if (radius == 0 && (adds || !words.has('^'))) {
    return run.fail(ErrorCode::PolarWords, 0, "at the origin");
  }
  if (words.has('@')) radius = run.mm(words['@']) + (adds ? radius : 0);
  if (words.has('^')) angle = words['^'] * (Angle::kPi / 180) + (adds ? angle : 0);
  x = radius * std::cos(angle);
  y = radius * std::sin(angle);
  target.named = static_cast<AxisBits>(target.named | bit_of(Axis::X) | bit_of(Axis::Y));
  return true;
}

/// G53: the words are machine coordinates with the tool length on top.
bool read_machine_target(Run& run, Target& target) {
  const Words& words = run.block.words;
  if (shifts_moves(run)) return run.fail(ErrorCode::CompG53, 0);
  Axes machine = machine_with_length(run);
  for (const Axis axis : kAllAxes) {
    const char word = letter(axis);
    if (!words.has(word)) continue;
    machine[index_of(axis)] = is_rotary(axis) ? words[word] : run.mm(words[word]);
    target.named = static_cast<AxisBits>(target.named | bit_of(axis));
  }
  target.to = program_of_machine_with_length(run, machine);
  return true;
}

/// Axes of a turned system move together.
void name_turned_axes(const Run& run, Target& target) {
  constexpr AxisBits kXy = bit_of(Axis::X) | bit_of(Axis::Y);
  if (run.state.rotation != 0 && (target.named & kXy) != 0) {
    target.named = static_cast<AxisBits>(target.named | kXy);
  }
}

/// The machine coordinates of the axes that are named, in a system that is not turned.
void set_named(const State& state, const Target& target, Position& machine) {
  for (AxisBits left = target.named; left != 0; left = static_cast<AxisBits>(left & (left - 1))) {
    const auto i = static_cast<std::size_t>(__builtin_ctz(left));
    machine.set_raw(kAllAxes[i], target.to[i] + state.g92[i] + state.system_offset[i]);
  }
}

bool is_no_move(const Run& run, const Axes& to) {
  return to == run.state.position && !run.state.is_displaced;
}

/// Per minute, rotary axes that move alone take F as degrees, whatever the units.
Feed feed_of_line(const Run& run, const Target& target, const Feed& feed) {
  constexpr AxisBits kRotary = bit_of(Axis::A) | bit_of(Axis::B) | bit_of(Axis::C);
  const bool is_per_minute = run.state.modes.feed == FeedMode::PerMinute;
  if ((target.named & kRotary) == 0 || !is_per_minute) [[likely]]
    return feed;
  for (const Axis axis : kAllAxes) {
    const auto i = index_of(axis);
    if (!is_rotary(axis) && target.to[i] != run.state.position[i]) return feed;
  }
  return Feed::per_minute(Length::mm(run.state.feed));
}

/// In G95 LinuxCNC takes up the lead again after each rapid: F counts in the units of that time.
void renew_lead(Run& run) {
  State& state = run.state;
  if (state.modes.feed != FeedMode::PerRevolution || !run.is_linuxcnc()) [[likely]]
    return;
  if (state.feed != 0 && state.feed_units != state.units) {
    run.warn(kLeadChanges, state.units == Units::Inch
                               ? "F counts in inches from this rapid on"
                               : "F counts in millimeters from this rapid on");
  }
  state.feed_units = state.units;
  state.has_lost_lead = false;
}

}  // namespace

bool check_polar_words(Run& run) {
  const Words& words = run.block.words;
  if (!words.has_any(kPolarWords)) return true;
  if (words.has('X') || words.has('Y')) {
    return run.fail(ErrorCode::PolarWords, 0, "with X or Y");
  }
  if (run.state.modes.plane == Plane::XY) return true;
  return run.fail(ErrorCode::PolarWords, 0, "outside of G17");
}

bool read_target(Run& run, Target& target) {
  const Words& words = run.block.words;
  if (run.block.g(GGroup::OneShot) == 530) [[unlikely]]
    return read_machine_target(run, target);
  begin_at_base(run, target.to);
  const bool is_incremental = run.state.modes.is_incremental;
  const double unit = run.state.mm_per_unit();
  if (words.has('X')) take_axis(target, Axis::X, words['X'] * unit, is_incremental);
  if (words.has('Y')) take_axis(target, Axis::Y, words['Y'] * unit, is_incremental);
  if (words.has('Z')) take_axis(target, Axis::Z, words['Z'] * unit, is_incremental);
  if (words.has_any(kRareAxisWords | kPolarWords)) [[unlikely]] {
    read_rare_axes(run, target, is_incremental);
    if (words.has_any(kPolarWords) && !read_polar(run, target)) return false;
  }
  return true;
}

bool read_feed(Run& run, bool is_arc, Feed& feed) {
  const State& state = run.state;
  const Words& words = run.block.words;
  if (state.modes.feed == FeedMode::InverseTime) {
    if (!words.has('F')) {
      return run.fail(is_arc ? ErrorCode::MissingFArc : ErrorCode::MissingFG1, 0);
    }
    if (words['F'] == 0) {
      return run.fail_word(is_arc ? ErrorCode::ZeroFeedArc : ErrorCode::ZeroFeedG1, 'F');
    }
    feed = Feed::inverse_time(words['F']);
    run.state.feed = 0;  // the rate of G94 or G95 is gone with the first move
    return true;
  }
  if (state.feed == 0) {
    return run.fail(is_arc ? ErrorCode::ZeroFeedArc : ErrorCode::ZeroFeedG1, 0);
  }
  if (state.modes.feed == FeedMode::PerRevolution && state.spindle.speed == 0)
    return run.fail(ErrorCode::FeedPerRevolution, 0);
  if (state.has_lost_lead) [[unlikely]]
    run.warn(kLeadLost,
             "F counts millimeters per second: a synchronized move has ended G95's lead");
  feed = run.modal_feed();
  return true;
}

void note_speed(Run& run, double length) {
  State& state = run.state;
  if (state.modes.feed != FeedMode::InverseTime || !run.is_linuxcnc()) [[likely]]
    return;
  constexpr double kOfNoLength = 0.1;
  state.feed_units = state.units;
  state.feed = length == 0 ? kOfNoLength : length / state.mm_per_unit() * run.block.words['F'];
}

namespace {

/// Of the axes that LinuxCNC times a line by: X, Y and Z where one of them moves, else U, V and W,
/// else the rotary ones, whose degrees it takes for units.
double timed_length(const Run& run, const Target& target) {
  const double unit = run.state.mm_per_unit();
  Axes from;
  begin_at_base(run, from);
  const auto length_of = [&](std::array<Axis, 3> axes, double scale) {
    double square = 0;
    for (const Axis axis : axes) {
      const double part = (target.to[index_of(axis)] - from[index_of(axis)]) * scale;
      if (std::fabs(part) > 1e-7 * unit) square += part * part;
    }
    return std::sqrt(square);
  };
  if (const double length = length_of({Axis::X, Axis::Y, Axis::Z}, 1); length > 0) return length;
  if (const double length = length_of({Axis::U, Axis::V, Axis::W}, 1); length > 0) return length;
  return length_of(kRotaryAxes, unit);
}

}  // namespace

bool straight_move(Run& run, int motion) {
  Target target;
  if (!read_target(run, target)) return false;
  Feed feed;
  if (motion == 10) {
    if (!read_feed(run, false, feed)) return false;
    if (run.state.modes.feed == FeedMode::InverseTime) [[unlikely]]
      note_speed(run, timed_length(run, target));
  }
  if (shifts_moves(run)) [[unlikely]] {
    run.state.passes = 0;
    if (motion == 0) renew_lead(run);
    return compensated_line(run, target, motion == 0, feed);
  }
  move_to(run, target, motion == 0, feed);
  return true;
}

bool home_move(Run& run, int g_code) {
  if (run.state.compensation.side != Side::Off) return run.fail(ErrorCode::CompHome, 0);
  Target target;
  if (!read_target(run, target)) return false;
  rapid_to(run, target);
  const bool moves_all = !run.is_linuxcnc() || target.named == 0;
  const auto first = static_cast<std::size_t>(g_code == 280 ? kHome : kSecondHome);
  Axes machine{};
  for (const Axis axis : kAllAxes) {
    machine[index_of(axis)] = from_memory(run, axis, run.parameters[first + index_of(axis)]);
  }
  const Axes home = program_of_machine_with_length(run, machine);
  for (const Axis axis : kAllAxes) {
    const bool is_there = (run.options.axes & set_of(letter(axis))) != 0;
    if (!is_there || (!moves_all && (target.named & bit_of(axis)) == 0)) continue;
    target.to[index_of(axis)] = home[index_of(axis)];
    target.named = static_cast<AxisBits>(target.named | bit_of(axis));
  }
  rapid_to(run, target);
  return true;
}

const Position& arrive(Run& run, const Target& target) {
  State& state = run.state;
  state.passes = 0;
  state.is_displaced = false;
  state.compensation.was_on = false;
  if (state.rotation == 0) [[likely]] {
    set_named(state, target, state.machine);
    state.position = target.to;
    return state.machine;
  }
  Target all = target;
  name_turned_axes(run, all);
  state.position = all.to;
  for (const Axis axis : kAllAxes) {
    if ((all.named & bit_of(axis)) != 0) state.machine.mark(axis);
  }
  state.machine = to_machine(run, state.position);
  return state.machine;
}

void rapid_to(Run& run, const Target& target) {
  renew_lead(run);
  if (is_no_move(run, target.to)) return;
  const Position& to = arrive(run, target);
  run.events().on_rapid({run.origin, to, run.rests_at_end()});
}

void line_to(Run& run, const Target& target, const Feed& feed) {
  line_to(run, target, feed, run.rests_at_end());
}

void move_to(Run& run, const Target& target, bool is_rapid, const Feed& feed) {
  is_rapid ? rapid_to(run, target) : line_to(run, target, feed);
}

void line_to(Run& run, const Target& target, const Feed& feed, bool rests) {
  if (is_no_move(run, target.to)) return;
  const Feed along = feed_of_line(run, target, feed);
  const Position& to = arrive(run, target);
  run.events().on_line({run.origin, to, along, rests});
}

bool arc_to(Run& run, const Target& target, const ArcShape& shape, const Feed& feed) {
  const State& state = run.state;
  const PlaneAxes axes = axes_of(state.modes.plane);
  if (state.rotation != 0 && state.modes.plane != Plane::XY) {
    return run.fail(ErrorCode::NotSupported, 0, "an arc in this plane of a turned system");
  }
  const auto shifted = [&](Axis axis, double value) {
    return Length::mm(value + state.g92[index_of(axis)] + state.system_offset[index_of(axis)]);
  };
  // A copy of the new place would have to wait for its numbers, which are only now being written.
  Arc arc{.origin = run.origin,
          .to = state.machine,
          .center_first = shifted(axes.first, shape.center_first),
          .center_second = shifted(axes.second, shape.center_second),
          .plane = state.modes.plane,
          .turn = shape.turn,
          .sweep = Angle::degrees(shape.sweep),
          .feed = feed,
          .rests = run.rests_at_end()};
  if (state.rotation == 0) [[likely]] {
    set_named(state, target, arc.to);
    arrive(run, target);
  } else {
    Axes center = target.to;
    center[index_of(axes.first)] = shape.center_first;
    center[index_of(axes.second)] = shape.center_second;
    const Position center_at = to_machine(run, center);
    arc.center_first = center_at.linear(axes.first);
    arc.center_second = center_at.linear(axes.second);
    arc.to = arrive(run, target);
  }
  run.events().on_arc(arc);
  return true;
}

}  // namespace dripline::interpreter::rs274ngc
