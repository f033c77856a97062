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

/// The F word comes back where the value differs; G94 and G95 alone leave none in force. In G93 F
/// belongs to its line.
double restored_feed(const SavedModes& saved, const State& state) {
  if (saved.modes.feed == FeedMode::InverseTime) return state.feed;
  if (saved.feed != state.feed) return reread(saved.feed, 1);
  return saved.modes.feed == state.modes.feed ? state.feed : 0;
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

}  // namespace

void save_modes(const Run& run, SavedModes& saved) {
  const State& state = run.state;
  saved = {true,
           false,
           state.modes,
           state.units,
           state.system,
           state.feed,
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
  if (saved.modes.plane != state.modes.plane && state.compensation.side != Side::Off)
    return run.fail(ErrorCode::CompPlane, 0, "M70 to M73");
  if (saved.units != state.units) change_units(run, saved.units);
  const std::int16_t motion = state.modes.motion;
  state.feed = restored_feed(saved, state);
  state.modes = saved.modes;
  state.modes.motion = motion;
  state.overrides = saved.overrides;
  if (state.has_header) run.events().on_override_inhibit(override_inhibit(run));
  if (!restore_offsets(run, saved)) return false;
  const SpindleState now = state.spindle.state;
  state.spindle = saved.spindle;
  state.spindle.state = now;
  turn_spindle(run, saved.spindle.state);
  if (saved.flood != state.flood || saved.mist != state.mist) {
    state.flood = saved.flood;
    state.mist = saved.mist;
    run.events().on_coolant({run.origin, state.flood, state.mist});
  }
  return true;
}

}  // namespace dripline::interpreter::rs274ngc
