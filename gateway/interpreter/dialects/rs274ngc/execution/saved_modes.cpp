#include "gateway/interpreter/dialects/rs274ngc/execution/saved_modes.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <iterator>

#include "gateway/interpreter/dialects/rs274ngc/compensation/compensation.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/coordinates.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/execution.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/machine_functions.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

bool has_length(const State& state) {
  return std::ranges::any_of(state.tool_length, [](double length) { return length != 0; });
}

/// A value as it is read again from text with so many decimals, of which LinuxCNC makes the codes
/// that bring it back.
double reread(double value, int decimals) {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "{:.{}f}", value, decimals);
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// The F word comes back where the value differs, in the units that have come back; G94 and G95
/// alone leave none in force. In G93 F belongs to its line.
void restore_feed(const SavedModes& saved, State& state) {
  if (saved.modes.feed != state.modes.feed) state.has_lost_lead = false;
  if (saved.modes.feed == FeedMode::InverseTime) return;
  if (saved.feed != state.shown_feed()) {
    state.feed = reread(saved.feed, 1);
    state.feed_units = state.units;
    state.has_lost_lead = false;
  } else if (saved.modes.feed != state.modes.feed) {
    state.feed = 0;
  }
}

/// As LinuxCNC writes it: with the codes that differ, G41 to G43 for the tool in the spindle.
bool restore_offsets(Run& run, const SavedModes& saved) {
  const State& state = run.state;
  if (saved.side != state.compensation.side) {
    const int code = saved.side == Side::Off ? 400 : saved.side == Side::Left ? 410 : 420;
    if (!switch_compensation(run, code)) return false;
  }
  if (saved.has_length != has_length(state) &&
      !set_length_offset(run, saved.has_length ? 430 : 490))
    return false;
  if (saved.system != state.system) load_system(run, saved.system);
  const bool has_g92 = run.parameters[kG92Active] != 0;
  return saved.has_g92 == has_g92 || execute_one_shot(run, saved.has_g92 ? 923 : 922);
}

bool is_other_path(const Modes& saved, const Modes& now) {
  const bool has_tolerance = saved.path == 640;
  return saved.path != now.path || (has_tolerance && (saved.path_tolerance != now.path_tolerance ||
                                                      saved.cam_tolerance != now.cam_tolerance));
}

/// The codes are on one line, where G41 comes before those that compensation forbids.
bool check_compensation(Run& run, const SavedModes& saved) {
  const State& state = run.state;
  const bool is_on = state.compensation.side != Side::Off;
  if (is_on && saved.modes.plane != state.modes.plane)
    return run.fail(ErrorCode::CompPlane, 0, "M70 to M73");
  if (is_on && saved.overrides != state.overrides)
    return run.fail(ErrorCode::CompNotAllowed, 0, "a change of the overrides");
  if (saved.side == Side::Off) return true;
  if (saved.system != state.system)
    return run.fail(ErrorCode::CompNotAllowed, 0, "a change of the coordinate system");
  if (saved.modes.retracts_to_start != state.modes.retracts_to_start)
    return run.fail(ErrorCode::CompNotAllowed, 0, "a change of the retract mode");
  if (is_other_path(saved.modes, state.modes))
    return run.fail(ErrorCode::CompNotAllowed, 0, "a change of the path mode");
  return true;
}

/// S comes back as a whole number, G96 without its D; it needs an S that differs.
bool restore_spindle(Run& run, const SpindleModes& saved) {
  SpindleModes& spindle = run.state.spindle;
  const bool changes_speed = saved.speed != spindle.speed;
  const bool changes_mode = saved.is_surface != spindle.is_surface;
  if (changes_mode && saved.is_surface && !changes_speed)
    return run.fail(ErrorCode::SpindleMode, 0, "M70 to M73: G96 needs S");
  if (changes_speed) spindle.speed = reread(saved.speed, 0);
  if (changes_mode) {
    spindle.is_surface = saved.is_surface;
    spindle.most = SpindleModes::kNoLimit;
  }
  // An oriented spindle is a stopped one.
  const SpindleState wanted = saved.is_turning() ? saved.state : SpindleState::Off;
  if (spindle.is_turning() && wanted == spindle.state) {
    if (changes_speed || changes_mode) show_spindle(run);
  } else if (spindle.is_turning() || wanted != SpindleState::Off) {
    turn_spindle(run, wanted);
  }
  return true;
}

/// M9 where neither was on, else M7 and M8: what came on since stays on.
void restore_coolant(Run& run, const SavedModes& saved) {
  State& state = run.state;
  const bool is_off = !saved.flood && !saved.mist;
  const bool flood = !is_off && (saved.flood || state.flood);
  const bool mist = !is_off && (saved.mist || state.mist);
  if (flood == state.flood && mist == state.mist) return;
  state.flood = flood;
  state.mist = mist;
  run.events().on_coolant({run.origin, flood, mist});
}

}  // namespace

void save_modes(const Run& run, SavedModes& saved) {
  const State& state = run.state;
  saved = {true,
           false,
           state.modes,
           state.units,
           state.system,
           state.shown_feed(),
           state.spindle,
           state.flood,
           state.mist,
           state.overrides,
           state.compensation.side,
           has_length(state),
           run.parameters[kG92Active] != 0};
}

bool restore_modes(Run& run, const SavedModes& saved) {
  State& state = run.state;
  if (!check_compensation(run, saved)) return false;
  if (saved.units != state.units) change_units(run, saved.units);
  const std::int16_t motion = state.modes.motion;
  restore_feed(saved, state);
  state.modes = saved.modes;
  state.modes.motion = motion;
  state.overrides = saved.overrides;
  if (state.has_header) run.events().on_override_inhibit(override_inhibit(run));
  if (!restore_offsets(run, saved) || !restore_spindle(run, saved.spindle)) return false;
  restore_coolant(run, saved);
  return true;
}

}  // namespace dripline::interpreter::rs274ngc
