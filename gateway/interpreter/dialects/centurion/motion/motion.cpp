#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/dialects/centurion/cycles/threads.hpp"
#include "gateway/interpreter/dialects/centurion/motion/arcs.hpp"
#include "gateway/interpreter/dialects/centurion/motion/corner_words.hpp"
#include "gateway/interpreter/dialects/centurion/motion/probe_moves.hpp"
#include "gateway/interpreter/dialects/centurion/motion/transform_stage.hpp"

namespace dripline::interpreter::centurion {
namespace {

/// The wider of the manual's tables of ranges: 99999.9999 inch, 99999.999 mm; X as a diameter.
constexpr double kMaxInches = 99999.9999;
constexpr double kMaxMillimeters = 99999.999;

/// A move of no length is no event: a start that is looked for learns here that the program has
/// the axes at this place.
void stay(Run& run, AxesNamed named) {
  ModalState& state = run.state;
  take_length(run, named);
  if (!state.is_searching) return;
  const Point at = machine_of(run, state.position);
  const std::uint8_t axes = static_cast<std::uint8_t>((named.x ? 1 : 0) | (named.z ? 2 : 0));
  const int fresh = axes & ~state.searched_axes;
  if ((fresh & 1) != 0) state.searched_to.x = run.length(at.x).mm();
  if ((fresh & 2) != 0) state.searched_to.z = run.length(at.z).mm();
  state.searched_axes |= axes;
}

/// After a move in machine coordinates, which are without a tool.
void leave_length(Run& run, AxesNamed named) {
  if (named.x) run.state.length_taken.x = 0;
  if (named.z) run.state.length_taken.z = 0;
}

/// R and AB from a pole, which is the current point unless the block names one (manual: polar
/// lines).
bool read_polar_target(Run& run, Target& target) {
  const Words& words = run.block.words;
  ModalState& state = run.state;
  if (words.has_any(kEndWords)) {
    return run.fail(ErrorCode::IllegalStatement, motion_column(run),
                    "a line has an end point or R and AB; a corner radius is written \",R\"");
  }
  if (words.has(Address::R)) {
    if (words[Address::R] < 0) {
      return run.fail(ErrorCode::NegativePolarRadius, words.column(Address::R));
    }
    state.retained.radius = words[Address::R];
    state.retained.has_radius = true;
  }
  if (!state.retained.has_radius) {
    return run.fail(ErrorCode::IllegalStatement, motion_column(run),
                    "a polar line has no length: no R in the block or before it");
  }
  if (words.has(Address::AB)) state.retained.end_angle = words[Address::AB];
  Point pole = state.position;
  if (words.has(Address::XC)) pole.x = state.origin.x + words[Address::XC] / 2;
  if (words.has(Address::ZC)) pole.z = state.origin.z + words[Address::ZC];
  if (words.has(Address::I)) pole.x += words[Address::I];
  if (words.has(Address::K)) pole.z += words[Address::K];
  target.to = polar(pole, state.retained.radius, state.retained.end_angle);
  target.named = kBothAxes;
  return true;
}

bool refuse_two_of_one_axis(Run& run, Address incremental) {
  return run.fail(ErrorCode::DuplicateAddress, run.block.words.column(incremental),
                  fmt::format("{} and its axis in one block", to_string(incremental)));
}

/// G60, and G0 with an overrun: beyond the target and back to it, always from the same side of
/// the machine (manual: G60).
void position_to(Run& run, const Target& target) {
  const bool is_single = run.axis_code() == 60;
  const Point overrun = run.parameters.point(is_single ? kSingleOverrun : kRapidOverrun);
  const Point from = machine_of(run, run.state.position);
  const Point to = machine_of(run, target.to);
  Point beyond = to;
  if (to.x != from.x) beyond.x += overrun.x;
  if (to.z != from.z) beyond.z += overrun.z;
  if (beyond == to) return rapid_to(run, target.to, target.named);
  rapid_untransformed(run, beyond, target.named);
  rapid_to(run, target.to, target.named);
}

}  // namespace

bool read_target(Run& run, Target& target) {
  const ModalState& state = run.state;
  return read_end_words(run, {state.position, state.origin, state.modes.is_incremental}, target);
}

bool read_end_words(Run& run, const EndFrame& frame, Target& target) {
  const Words& words = run.block.words;
  target.to = frame.from;
  if (words.has(Address::X)) {
    const double x = words[Address::X] * 0.5;
    target.to.x = frame.is_incremental ? target.to.x + x : frame.zero.x + x;
    target.named.x = true;
  }
  if (words.has(Address::Z)) {
    const double z = words[Address::Z];
    target.to.z = frame.is_incremental ? target.to.z + z : frame.zero.z + z;
    target.named.z = true;
  }
  if (!words.has_any(set_of(Address::U, Address::W))) return check_target(run, target.to);
  if (words.has(Address::U)) {
    if (target.named.x) return refuse_two_of_one_axis(run, Address::U);
    target.to.x += words[Address::U] * 0.5;
    target.named.x = true;
  }
  if (words.has(Address::W)) {
    if (target.named.z) return refuse_two_of_one_axis(run, Address::W);
    target.to.z += words[Address::W];
    target.named.z = true;
  }
  return check_target(run, target.to);
}

bool move(Run& run) {
  const Words& words = run.block.words;
  // AA means nothing to a line; alone it moves nothing.
  if (!words.has_any(kEndWords | kPolarWords)) return true;
  run.ledger.take_all();
  if (run.block.parts.thread_code != 0) [[unlikely]]
    take_lead_change(run);
  const MotionMode mode = run.axis_code() == 60 ? MotionMode::Rapid : run.state.modes.motion;
  if (mode >= MotionMode::Clockwise) return move_on_arc(run);
  Target target;
  if (words.has_any(kPolarWords)) [[unlikely]] {
    if (words.has(Address::AA)) run.state.retained.start_angle = words[Address::AA];
    if (!words.has_any((kEndWords | kPolarWords) & ~set_of(Address::AA))) return true;
    if (words.has_any(kPolarWords & ~set_of(Address::AA))) {
      if (!read_polar_target(run, target) || !check_target(run, target.to)) return false;
    } else if (!read_target(run, target)) {
      return false;
    }
  } else if (!read_target(run, target)) {
    return false;
  }
  if (run.block.parts.probe) [[unlikely]]
    return probe_line(run, target);
  if (run.block.parts.thread_code != 0) [[unlikely]]
    return thread_to(run, target, std::nullopt);
  if (mode == MotionMode::Rapid) {
    position_to(run, target);
    return true;
  }
  if (!check_feed(run)) return false;
  if (target.to == run.state.position && !run.block.is_back_line()) {
    stay(run, target.named);
    return true;
  }
  announce_line(run);
  run.events().on_line(
      {run.origin, event_position(run, target.to, target.named), run.active_feed(), run.rests()});
  arrive(run, target.to, target.named);
  return true;
}

void rapid_to(Run& run, const Point& to, AxesNamed named) {
  if (to == run.state.position) return stay(run, named);
  run.events().on_rapid({run.origin, event_position(run, to, named)});
  arrive(run, to, named);
}

void feed_to(Run& run, const Point& to, AxesNamed named, Feed feed) {
  if (to == run.state.position) return stay(run, named);
  run.events().on_line({run.origin, event_position(run, to, named), feed, run.rests()});
  arrive(run, to, named);
}

void rapid_untransformed(Run& run, const Point& machine, AxesNamed named) {
  const Point from = machine_of(run, run.state.position);
  if (machine == from) return stay(run, named);
  const Position at = marked_position(run, from, machine, named);
  run.machine_events().on_rapid({run.origin, at});
  arrive(run, programmed_of(run, machine), named);
}

void machine_rapid_to(Run& run, const Point& machine, AxesNamed named) {
  rapid_untransformed(run, machine, named);
  leave_length(run, named);
}

void machine_feed_to(Run& run, const Point& machine, AxesNamed named) {
  const Point from = machine_of(run, run.state.position);
  if (machine == from) {
    stay(run, named);
  } else {
    const Position at = marked_position(run, from, machine, named);
    run.machine_events().on_line({run.origin, at, run.active_feed(), run.rests()});
    arrive(run, programmed_of(run, machine), named);
  }
  leave_length(run, named);
}

bool check_target(Run& run, const Point& to) {
  const double limit = run.state.units == Units::Inch ? kMaxInches : kMaxMillimeters;
  if (std::fabs(to.x) * 2 <= limit && std::fabs(to.z) <= limit) [[likely]]
    return true;
  return run.fail(ErrorCode::TooManyDigits, motion_column(run),
                  fmt::format("X{} Z{} is beyond {}", to.x * 2, to.z, limit));
}

bool check_feed(Run& run) {
  if (run.state.active_feed() > 0) [[likely]]
    return true;
  return run.fail(ErrorCode::FeedOutOfRange, motion_column(run),
                  run.state.modes.is_feed_per_revolution ? "no feed per revolution was given"
                                                         : "no feed per minute was given");
}

Position event_position(Run& run, const Point& point, AxesNamed named) {
  return marked_position(run, run.state.position, point, named);
}

Position marked_position(Run& run, const Point& from, const Point& point, AxesNamed named) {
  ModalState& state = run.state;
  if (point.x != from.x) state.moved_axes |= 1;
  if (point.z != from.z) state.moved_axes |= 2;
  Position position;
  position.set(Axis::X, run.length(point.x));
  position.set(Axis::Z, run.length(point.z));
  if (!named.x && !(state.moved_axes & 1)) position.unmark(Axis::X);
  if (!named.z && !(state.moved_axes & 2)) position.unmark(Axis::Z);
  return position;
}

void arrive(Run& run, const Point& at, AxesNamed named) {
  ModalState& state = run.state;
  run.loops.note_progress();
  const Point from = machine_of(run, state.position);
  state.previous_machine = machine_position(state);
  state.previous = state.position;
  state.position = at;
  const Point to = machine_of(run, at);
  constexpr double kRounding = 1e-9;
  take_length(run, {named.x || std::fabs(to.x - from.x) > kRounding,
                    named.z || std::fabs(to.z - from.z) > kRounding});
}

void take_length(Run& run, AxesNamed named) {
  const Point length = tool_length(run.state, run.parameters);
  if (named.x) run.state.length_taken.x = length.x;
  if (named.z) run.state.length_taken.z = length.z;
}

std::uint32_t motion_column(const Run& run) {
  const Words& words = run.block.words;
  std::uint32_t first = 0;
  for (std::size_t i = 0; i < kAddressCount; ++i) {
    const auto address = static_cast<Address>(i);
    if (!words.has(address) || !((kEndWords | kPolarWords) & set_of(address))) continue;
    if (first == 0 || words.column(address) < first) first = words.column(address);
  }
  return first;
}

}  // namespace dripline::interpreter::centurion
