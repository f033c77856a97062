#include "gateway/interpreter/dialects/tnc155/execution/machine_functions.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <bitset>
#include <cmath>

namespace dripline::interpreter::tnc155 {
namespace {

using CodeSet = std::bitset<100>;

CodeSet codes(std::initializer_list<std::pair<int, int>> ranges) {
  CodeSet set;
  for (const auto& [first, last] : ranges) {
    for (int code = first; code <= last; ++code) set.set(static_cast<std::size_t>(code));
  }
  return set;
}

/// Free functions: what they mean is the machine builder's, when they are put out is not.
const CodeSet& at_begin() {
  static const CodeSet kSet =
      codes({{7, 7}, {11, 11}, {15, 29}, {31, 31}, {36, 51}, {55, 59}, {61, 62}, {71, 88}});
  return kSet;
}
const CodeSet& at_end() {
  static const CodeSet kSet =
      codes({{1, 1}, {10, 10}, {12, 12}, {32, 35}, {52, 54}, {60, 60}, {63, 70}});
  return kSet;
}

void switch_coolant(Run& run, bool on) {
  run.state.coolant.flood = on;
  run.events().on_coolant({run.origin, on, false});
}

/// M94 reduces the display of a rotary axis by full revolutions. The axis does not move, so the
/// datum moves by them. It is kept from run to run: before a start in the middle it has moved
/// already when that part ran, and would move twice.
bool reduce_rotary_axes(Run& run) {
  State& state = run.state;
  for (const Axis axis : {Axis::A, Axis::B, Axis::C}) {
    const auto i = static_cast<std::size_t>(axis);
    const double revolutions = std::trunc(state.nominal[i] / 360) * 360;
    if (revolutions != 0 && state.start.is_searching) {
      return run.fail(
          ErrorCode::ProgramStartUndefined,
          fmt::format("a start after M94 would lose the datum of {}, which it has moved "
                      "by {:+.0f} when it was executed: start before it",
                      letter(axis), revolutions));
    }
    state.nominal[i] -= revolutions;
    state.transformation.datum[i] += revolutions;
  }
  state.transformation.update();
  ++run.frame_changes;
  return true;
}

/// Coded speeds: the next of the table.
bool code_speed(Run& run, double& speed) {
  const auto& table = run.options.spindle_table;
  if (speed == 0) return true;
  const auto at = std::lower_bound(table.begin(), table.end(), speed * (1 - 1e-12));
  if (at == table.end()) {
    return run.fail(ErrorCode::WrongRpm,
                    fmt::format("S {} is above {}", speed, table.empty() ? 0 : table.back()));
  }
  speed = *at;
  return true;
}

}  // namespace

void turn_spindle(Run& run, SpindleState to) {
  SpindleModes& spindle = run.state.spindle;
  spindle.state = to;
  Spindle event;
  event.origin = run.origin;
  event.state = to;
  event.revolutions_per_minute = to == SpindleState::Off ? 0 : spindle.speed;
  run.events().on_spindle(event);
}

bool set_speed(Run& run, double speed) {
  const ControlOptions& options = run.options;
  if (speed < options.spindle_minimum || speed > options.spindle_maximum) {
    return run.fail(ErrorCode::WrongRpm,
                    fmt::format("S {} is not {} to {}", speed, options.spindle_minimum,
                                options.spindle_maximum));
  }
  if (options.spindle_coded && !code_speed(run, speed)) return false;
  SpindleModes& spindle = run.state.spindle;
  const bool changes = !spindle.has_speed || spindle.speed != speed;
  spindle.speed = speed;
  spindle.has_speed = true;
  if (changes && spindle.state != SpindleState::Off) turn_spindle(run, spindle.state);
  return true;
}

void switch_off(Run& run) {
  if (run.state.spindle.state != SpindleState::Off) turn_spindle(run, SpindleState::Off);
  if (run.state.coolant.flood) switch_coolant(run, false);
}

void stop(Run& run, StopKind kind) {
  run.loops.note_progress();
  run.events().on_stop({run.origin, kind});
}

bool begin_m(Run& run, int m) {
  switch (m) {
    case 3:
    case 4:
    case 13:
    case 14:
      turn_spindle(run, m % 10 == 3 ? SpindleState::Clockwise : SpindleState::Counterclockwise);
      if (m > 10) switch_coolant(run, true);
      return true;
    case 8:
      switch_coolant(run, true);
      return true;
    case 94:
      return reduce_rotary_axes(run);
    case 89:
      if (!run.options.m89_modal) run.events().on_miscellaneous({run.origin, m});
      return true;
    default:
      break;
  }
  if (at_begin().test(static_cast<std::size_t>(m))) run.events().on_miscellaneous({run.origin, m});
  return true;
}

bool end_m(Run& run, int m) {
  switch (m) {
    case 0:
      switch_off(run);
      stop(run, StopKind::Program);
      return true;
    case 5:
      turn_spindle(run, SpindleState::Off);
      return true;
    case 6:
      switch_off(run);
      run.events().on_miscellaneous({run.origin, m});
      if (run.options.m06_stop) stop(run, StopKind::ToolChange);
      return true;
    case 9:
      switch_coolant(run, false);
      return true;
    default:
      break;
  }
  if (at_end().test(static_cast<std::size_t>(m))) run.events().on_miscellaneous({run.origin, m});
  return true;
}

}  // namespace dripline::interpreter::tnc155
