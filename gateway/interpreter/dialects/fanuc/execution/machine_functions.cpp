#include "gateway/interpreter/dialects/fanuc/execution/machine_functions.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>

#include "gateway/interpreter/dialects/fanuc/turning/turning.hpp"

namespace dripline::interpreter::fanuc {
namespace {

constexpr double kMaxSpeed = 20000;

void deliver_spindle(Run& run) {
  const SpindleModes& spindle = run.state.spindle;
  Spindle event{run.origin, spindle.state, 0, {}, {}};
  if (is_turning(spindle.state)) {
    event.revolutions_per_minute = spindle.revolutions;
    if (run.state.g[kSpindleGroup] == 96) {
      event.surface_speed = Length::mm(spindle.surface);
      if (spindle.limit > 0) event.max_revolutions = spindle.limit;
    }
  }
  run.events().on_spindle(event);
}

void set_coolant(Run& run, bool flood, bool mist) {
  Coolant& coolant = run.state.coolant;
  if (coolant.flood == flood && coolant.mist == mist) return;
  coolant = {run.origin, flood, mist};
  run.events().on_coolant(coolant);
}

bool select_tool(Run& run) {
  const Word& word = run.block.words[T];
  const double number = run.whole(word);
  if (!(number >= 0 && number <= 99'999'999)) {
    return run.fail(ErrorCode::TooManyDigits, word.column, fmt::format("T{}", number));
  }
  ToolModes& tool = run.state.tool;
  tool.pending = static_cast<int>(number);
  tool.is_pending = true;
  run.state.last.t = tool.pending;
  run.events().on_tool({run.origin, tool.pending, true, {}});
  return true;
}

void change_tool(Run& run) {
  ToolModes& tool = run.state.tool;
  if (!tool.is_pending) run.warn(WarningCode::NoToolSelected, 0);
  if (tool.is_pending) tool.active = tool.pending;
  tool.is_pending = false;
  const bool by_hand = !run.options.has_tool_changer;
  if (by_hand && is_turning(run.state.spindle.state)) turn_spindle(run, SpindleState::Off);
  run.events().on_tool({run.origin, tool.active, false, {}});
  if (by_hand) run.events().on_stop({run.origin, StopKind::ToolChange});
}

bool acts_after(const Run& run, int code) {
  constexpr std::array kAfter{0, 1, 2, 5, 9, 30, 98, 99, 198, 199};
  if (std::find(kAfter.begin(), kAfter.end(), code) != kAfter.end()) return true;
  // `before_m` lists what this builder outputs before the motion: all the rest when it is empty.
  const auto& before = run.options.before_m;
  const bool is_builders =
      code != 3 && code != 4 && code != 6 && code != 7 && code != 8 && code != 19;
  return is_builders && !before.empty() &&
         std::find(before.begin(), before.end(), code) == before.end();
}

void perform(Run& run, int code) {
  switch (code) {
    case 0:
      run.state.limits = {};
      run.events().on_stop({run.origin, StopKind::Program});
      return;
    case 1:
      if (!run.options.optional_stop) return;
      run.state.limits = {};
      run.events().on_stop({run.origin, StopKind::Optional});
      return;
    case 3:
      return turn_spindle(run, SpindleState::Clockwise);
    case 4:
      return turn_spindle(run, SpindleState::Counterclockwise);
    case 5:
      return turn_spindle(run, SpindleState::Off);
    case 6:
      return change_tool(run);
    case 7:
      return set_coolant(run, run.state.coolant.flood, true);
    case 8:
      return set_coolant(run, true, run.state.coolant.mist);
    case 9:
      return set_coolant(run, false, false);
    case 19:
      return turn_spindle(run, SpindleState::Oriented);
    case 2:
    case 30:
    case 98:
    case 99:
    case 198:
    case 199:
      return;  // flow.cpp
    case 29:
      run.state.is_rigid_tapping = true;
      [[fallthrough]];
    default:
      run.events().on_miscellaneous({run.origin, code});
      return;
  }
}

void perform_all(Run& run, bool after) {
  const Block& block = run.block;
  for (std::size_t i = 0; i < block.parts.m_count; ++i) {
    if (acts_after(run, block.m[i]) == after) perform(run, block.m[i]);
    if (!after) run.state.last.m = block.m[i];
  }
}

}  // namespace

void turn_spindle(Run& run, SpindleState state) {
  SpindleModes& spindle = run.state.spindle;
  if (spindle.state == state && !run.state.speed_changed) return;
  spindle.state = state;
  run.state.speed_changed = false;
  deliver_spindle(run);
}

OverrideInhibit override_inhibit(const Run& run) {
  const ModalState& state = run.state;
  const bool is_tapping_mode = state.g[kPathGroup] == 63;
  const auto has = [&state](Counter place, unsigned bit) {
    return (static_cast<unsigned>(state.counters[place]) & bit) != 0;
  };
  OverrideInhibit lock{.origin = run.origin};
  lock.feed_override = lock.spindle_override = is_tapping_mode || has(kHold, 2);
  lock.single_block = has(kSingle, 1);
  if (is_tapping_mode || has(kHold, 1)) lock.hold = FeedHoldInhibit::Later;
  return lock;
}

/// Before the program's first event the header reports it.
void show_override_inhibit(Run& run) {
  if (run.state.has_header) run.events().on_override_inhibit(override_inhibit(run));
}

void all_off(Run& run) {
  run.state.speed_changed = false;
  if (run.state.spindle.state != SpindleState::Off) turn_spindle(run, SpindleState::Off);
  set_coolant(run, false, false);
}

bool apply_speed(Run& run) {
  ModalState& state = run.state;
  const Words& words = run.block.words;
  const bool is_surface = state.g[kSpindleGroup] == 96;
  if (run.block.names(kSpindleGroup) && is_surface && words.has(P)) {
    const double axis = run.whole(words[P]);
    if (!(axis >= 0 && axis <= 4)) {
      return run.fail(ErrorCode::IllegalAxis, words.column(P), fmt::format("G96 P{}", axis));
    }
  }
  if (!words.has(S)) {
    // G96 and G97 without S: the speed that is in force again is the one of before.
    const double again = is_surface ? state.spindle.surface : state.spindle.revolutions;
    if (state.spindle.is_surface != is_surface && again > 0) {
      state.spindle.is_surface = is_surface;
      state.speed_changed = true;
    }
    return true;
  }
  const double speed = run.whole(words[S]);
  if (!(speed >= 0 && speed <= kMaxSpeed)) {
    return run.fail(ErrorCode::TooManyDigits, words.column(S),
                    fmt::format("S{} is above {}", speed, kMaxSpeed));
  }
  state.last.s = static_cast<int>(speed);
  SpindleModes& spindle = state.spindle;
  const SpindleModes before = spindle;
  if (run.block.parts.one_shot == 92) {
    spindle.limit = speed;
  } else if (is_surface) {
    spindle.surface = speed * mm_per_surface_unit(state.units);
  } else {
    spindle.revolutions = speed;
  }
  if (run.block.parts.one_shot != 92) spindle.is_surface = is_surface;
  state.speed_changed |= spindle.is_surface != before.is_surface || spindle.limit != before.limit ||
                         spindle.surface != before.surface ||
                         spindle.revolutions != before.revolutions;
  return true;
}

bool apply_before_motion(Run& run) {
  if (run.block.words.has(T)) {
    if (!(run.options.is_lathe ? select_turret(run) : select_tool(run))) return false;
  }
  perform_all(run, false);
  // A new speed of a spindle that is already running.
  if (run.state.speed_changed && is_turning(run.state.spindle.state)) {
    turn_spindle(run, run.state.spindle.state);
  }
  run.state.speed_changed = false;
  return true;
}

bool apply_after_motion(Run& run) {
  perform_all(run, true);
  return true;
}

bool set_look_ahead(Run& run) {
  const Block& block = run.block;
  const Words& words = block.words;
  const std::uint8_t code = block.parts.one_shot;
  const Address address = code == kContourControl ? Q : P;
  const std::string_view name = code == kContourControl ? "G05.1" : code == 5 ? "G05" : "G08";
  const double on = code == 5 ? 10000 : 1;
  const double value = words.has(address) ? run.whole(words[address]) : -1;
  run.ledger.take(set_of(address));
  if (value != 0 && value != on) {
    return run.fail(
        ErrorCode::ImproperG, block.parts.g_column,
        fmt::format("{} with {}0 or {}{} only", name, letter(address), letter(address), on));
  }
  if (words.has_any(kAxisWords)) {
    return run.fail(ErrorCode::ImproperCommand, words.first_column(kAxisWords),
                    fmt::format("a move beside {}", name));
  }
  run.warn(WarningCode::LookAhead, block.parts.g_column);
  return true;
}

}  // namespace dripline::interpreter::fanuc
