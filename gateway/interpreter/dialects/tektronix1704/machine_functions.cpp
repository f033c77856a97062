#include "gateway/interpreter/dialects/tektronix1704/machine_functions.hpp"

#include <fmt/format.h>

#include "gateway/interpreter/dialects/tektronix1704/path_rules.hpp"

namespace dripline::interpreter::tektronix1704 {
namespace {

constexpr int kQuillUp = 50;
constexpr int kQuillDown = 51;

void tell_spindle(Run& run) {
  const State& state = run.state;
  Spindle event;
  event.origin = run.origin;
  event.state = state.spindle;
  if (state.spindle != SpindleState::Off && run.options.has_spindle_speed) {
    event.revolutions_per_minute =
        run.options.spindle_speed[static_cast<std::size_t>(state.spindle_code)];
  }
  run.events().on_spindle(event);
}

void turn_spindle(Run& run, SpindleState to) {
  run.state.spindle = to;
  tell_spindle(run);
}

void set_coolant(Run& run, bool flood, bool mist) {
  run.state.flood = flood;
  run.state.mist = mist;
  run.events().on_coolant({run.origin, flood, mist});
}

void stop_coolant_if_on(Run& run) {
  if (run.state.flood || run.state.mist) set_coolant(run, false, false);
}

/// M10 to M29, M31 to M99: the machine builder's own.
void do_user_function(Run& run, int code) {
  run.events().on_miscellaneous({run.origin, code});
  const std::string& name = run.options.m_names[static_cast<std::size_t>(code)];
  if (!name.empty()) run.events().on_message({run.origin, name});
}

void do_spindle_stop(Run& run) {
  turn_spindle(run, SpindleState::Off);
  if (run.options.m05_stops_coolant) stop_coolant_if_on(run);
}

bool do_mist(Run& run) {
  if (!run.options.has_mist) {
    run.warn(Fault::NotFitted, run.origin, 0, "M07");
    return true;
  }
  set_coolant(run, run.state.flood, true);
  return true;
}

bool change_tool(Run& run) {
  if (run.options.has_tool_changer) {
    run.events().on_tool({run.origin, run.state.tool_code, false, std::nullopt});
    return true;
  }
  if (!check_stop(run)) return false;
  run.events().on_stop({run.origin, StopKind::ToolChange});
  return true;
}

bool stop_program(Run& run, StopKind kind) {
  if (kind == StopKind::Optional && !run.options.optional_stop) return true;
  if (!check_stop(run)) return false;
  run.events().on_stop({run.origin, kind});
  return true;
}

/// When the block's other commands are done (manual: M functions).
bool is_delayed(const ControlOptions& options, int code) {
  switch (code) {
    case 0:
    case 1:
    case 2:
    case 30:
      return true;
    case 5:
      return options.m05_is_delayed;
    case 6:
      return !options.has_tool_changer;
    case 9:
      return options.m09_is_delayed;
    default:
      return false;
  }
}

bool do_m(Run& run, int code) {
  switch (code) {
    case 0:
      return stop_program(run, StopKind::Program);
    case 1:
      return stop_program(run, StopKind::Optional);
    case 2:
    case 30:
      if (!check_stop(run)) return false;
      end_run(run, run.state.blocks + 1, code == 30);
      return true;
    case 3:
      turn_spindle(run, SpindleState::Clockwise);
      return true;
    case 4:
      turn_spindle(run, SpindleState::Counterclockwise);
      return true;
    case 5:
      do_spindle_stop(run);
      return true;
    case 6:
      return change_tool(run);
    case 7:
      return do_mist(run);
    case 8:
      set_coolant(run, true, run.state.mist);
      return true;
    case 9:
      set_coolant(run, false, false);
      return true;
    default:
      break;
  }
  if (run.options.has_quill && (code == kQuillUp || code == kQuillDown)) check_quill(run);
  do_user_function(run, code);
  return true;
}

}  // namespace

void load_codes(Run& run) {
  State& state = run.state;
  const Words& words = state.block.words;
  if (words.has(Address::S)) {
    if (run.options.has_spindle_speed) {
      state.spindle_code = words[Address::S];
      const bool turns_now =
          words.has(Address::M) && words[Address::M] >= 3 && words[Address::M] <= 4;
      if (state.spindle != SpindleState::Off && !turns_now) tell_spindle(run);
    } else {
      run.warn(Fault::NotFitted, run.origin, 0, "S");
    }
  }
  if (words.has(Address::T)) {
    if (run.options.has_tool_codes) {
      state.tool_code = words[Address::T];
      run.events().on_tool({run.origin, state.tool_code, true, std::nullopt});
    } else {
      run.warn(Fault::NotFitted, run.origin, 0, "T");
    }
  }
}

bool do_m_before(Run& run) {
  const Words& words = run.state.block.words;
  if (!words.has(Address::M)) [[likely]]
    return true;
  const int code = words[Address::M];
  check_m_word(run, code, flows_on(run.state.motion) && words.has_any(kEndWords));
  return is_delayed(run.options, code) || do_m(run, code);
}

bool do_m_after(Run& run) {
  const Words& words = run.state.block.words;
  if (!words.has(Address::M)) [[likely]]
    return true;
  return !is_delayed(run.options, words[Address::M]) || do_m(run, words[Address::M]);
}

void stroke_quill(Run& run) {
  check_quill(run);
  do_user_function(run, kQuillDown);
  do_user_function(run, kQuillUp);
}

void end_run(Run& run, std::uint64_t blocks, bool rewind) {
  State& state = run.state;
  if (state.spindle != SpindleState::Off) turn_spindle(run, SpindleState::Off);
  stop_coolant_if_on(run);
  state.motion = Motion::G00;
  state.is_incremental = state.drills = false;
  state.phase = RunPhase::Ended;
  run.events().on_end({run.origin, blocks, rewind});
}

}  // namespace dripline::interpreter::tektronix1704
