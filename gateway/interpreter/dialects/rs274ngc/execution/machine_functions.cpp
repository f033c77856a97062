#include "gateway/interpreter/dialects/rs274ngc/execution/machine_functions.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/dialects/rs274ngc/compensation/compensation.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/coordinates.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/saved_modes.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/splines.hpp"
#include "gateway/interpreter/dialects/rs274ngc/memory/parameter_access.hpp"
#include "gateway/interpreter/dialects/rs274ngc/memory/tool_table.hpp"

namespace dripline::interpreter::rs274ngc {

void show_spindle(Run& run) {
  const SpindleModes& spindle = run.state.spindle;
  Spindle event;
  event.origin = run.origin;
  event.state = spindle.state;
  if (spindle.turns_by_surface()) {
    const bool is_inch = run.state.units == Units::Inch;  // feet or meters a minute
    event.surface_speed =
        is_inch ? Length::inch(12 * spindle.speed) : Length::mm(1000 * spindle.speed);
    if (std::isfinite(spindle.most)) event.max_revolutions = spindle.most;
  } else {
    event.revolutions_per_minute = spindle.speed;
  }
  run.events().on_spindle(event);
}

namespace {

void apply_coolant(Run& run, int code) {
  State& state = run.state;
  const bool flood = code == 8 || (code == 7 && state.flood);
  const bool mist = code == 7 || (code == 8 && state.mist);
  if (flood == state.flood && mist == state.mist) return;
  state.flood = flood;
  state.mist = mist;
  run.events().on_coolant({run.origin, flood, mist});
}

/// LinuxCNC refuses them while radius compensation is on, with a radius of 0 too.
bool is_allowed_now(Run& run, int code) {
  if (!run.is_linuxcnc() || run.state.compensation.side == Side::Off) return true;
  return run.fail(ErrorCode::CompNotAllowed, 0, fmt::format("M{}", code));
}

bool apply_override(Run& run, int code) {
  if (!is_allowed_now(run, code)) return false;
  Overrides& overrides = run.state.overrides;
  const bool enables = run.block.words.value_or('P', 1) != 0;
  const bool was_adaptive = overrides.adaptive;
  if (code == 48 || code == 49) overrides.speed = overrides.feed = code == 48;
  if (code == 50) overrides.feed = enables;
  if (code == 51) overrides.speed = enables;
  if (code == 52) overrides.adaptive = enables;
  if (code == 53) overrides.hold = enables;
  Miscellaneous event{.origin = run.origin, .code = code};
  // A machine without adaptive feed has nothing to turn off.
  event.is_done = code != 52 || !(enables || was_adaptive);
  if (code == 52) event.p = enables ? 1 : 0;
  run.events().on_miscellaneous(event);
  run.events().on_override_inhibit(override_inhibit(run));
  return true;
}

/// A setup without tools knows none: any number will do.
bool is_known_tool(const Run& run, double number) {
  return run.tools.empty() || number == 0 ||
         find_tool(run, static_cast<int>(std::fmin(number, 1e9))) != nullptr;
}

/// M61: the tool that is in the spindle already.
bool name_tool(Run& run) {
  const double number = std::round(run.block.words.value_or('Q', -1));
  if (!(number >= 0 && number <= 99'999)) return run.fail_word(ErrorCode::ToolNumber, 'Q');
  if (!is_known_tool(run, number)) {
    return run.fail_word(ErrorCode::ToolNotFound, 'Q', fmt::format("Q{}", number));
  }
  run.state.tool.loaded = static_cast<int>(number);
  return true;
}

bool change_tool(Run& run, int code) {
  State& state = run.state;
  if (run.is_linuxcnc() && state.compensation.side != Side::Off) {
    return run.fail(ErrorCode::CompNotAllowed, 0, "a tool change");
  }
  if (code == 61) {
    if (!name_tool(run)) return false;
  } else {
    if (state.spindle.is_turning()) turn_spindle(run, SpindleState::Off);
    state.tool.loaded = state.tool.selected;
  }
  run.events().on_tool({.origin = run.origin,
                        .number = state.tool.loaded,
                        .offset = {},
                        .is_in_spindle = code == 61});
  if (code != 61 && !run.options.has_tool_changer) {
    run.events().on_stop({run.origin, StopKind::ToolChange});
  }
  // A move of the same line still begins at the programmed place.
  if (run.is_linuxcnc() && run.block.motion < 0) continue_from_tool(run);
  return true;
}

bool orient(Run& run) {
  const double angle = run.block.words.value_or('R', 0);
  if (!(angle >= 0 && angle <= 360)) return run.fail_word(ErrorCode::OrientWords, 'R');
  turn_spindle(run, SpindleState::Oriented);
  return true;
}

/// The numbers of LinuxCNC's inputs and outputs, digital and analog.
constexpr double kMaxPin = 63;

/// M62 to M65. What M62 and M63 switch with the next motion is switched before it.
bool switch_output(Run& run, int code) {
  const double pin = std::round(run.block.words.value_or('P', -1));
  if (!(pin >= 0 && pin <= kMaxPin))
    return run.fail_word(ErrorCode::IoWords, 'P', fmt::format("M{}", code));
  run.events().on_pin({run.origin, Axis::X, static_cast<int>(pin), code == 62 || code == 64, {}});
  return true;
}

/// M67, M68: an analog output. What M67 writes with the next motion is written before it.
bool write_output(Run& run, int code) {
  const Words& words = run.block.words;
  const double output = std::round(words.value_or('E', -1));
  if (!(output >= 0 && output <= kMaxPin) || !words.has('Q')) {
    return run.fail_word(ErrorCode::IoWords, 'E', fmt::format("M{}", code));
  }
  run.events().on_miscellaneous({.origin = run.origin, .code = code, .e = output, .q = words['Q']});
  return true;
}

/// What a wait comes to where the input stays as it is.
bool is_fulfilled(InputWait wait, bool state) {
  return (wait == InputWait::High && state) || (wait == InputWait::Low && !state);
}

/// M66 of a digital input: at once, or when it changes. False: the answer is awaited.
bool read_digital(Run& run, InputWait wait) {
  const Words& words = run.block.words;
  const double pin = std::round(words['P']);
  if (pin > kMaxPin) return run.fail_word(ErrorCode::IoWords, 'P', "M66");
  bool state = false;
  if (run.options.answers_pins) {
    for (const std::int64_t each : run.options.pins) state |= static_cast<double>(each) == pin;
    if (wait != InputWait::Nothing) state = is_fulfilled(wait, state);
  } else if (run.answer) {
    state = std::get<bool>(*run.answer);
    run.answer.reset();
  } else {
    return run.ask(InputQuestion{static_cast<int>(pin), wait, words.value_or('Q', 0)});
  }
  run.events().on_miscellaneous({.origin = run.origin, .code = 66, .is_done = true});
  constexpr double kTimeout = -1;
  const bool ends_low = wait == InputWait::Fall || wait == InputWait::Low;
  const double waited = !state ? kTimeout : ends_low ? 0 : 1;
  run.parameters[kInputResult] = wait == InputWait::Nothing ? (state ? 1 : 0) : waited;
  return true;
}

/// M66 of an analog input, which LinuxCNC's HAL has as a pin. A machine without it answers nothing:
/// whether it can do M66 is then its own affair, and the result is 0.
bool read_analog(Run& run) {
  const double input = std::round(run.block.words['E']);
  if (!(input >= 0 && input <= kMaxPin)) return run.fail_word(ErrorCode::IoWords, 'E', "M66");
  std::optional<double> value;
  if (run.options.hal || !run.options.answers_pins) {
    const auto signal = ask_signal(run, fmt::format("motion.analog-in-{:02.0f}", input));
    if (!signal) return false;
    value = signal->value;
  }
  run.events().on_miscellaneous({.origin = run.origin, .code = 66, .is_done = value.has_value()});
  run.parameters[kInputResult] = value.value_or(0);
  return true;
}

/// M66: the result is #5399.
bool read_input(Run& run) {
  const Words& words = run.block.words;
  if (words.has('P') == words.has('E') || words.value_or('P', 0) < 0) {
    return run.fail(ErrorCode::IoWords, 0, "M66 needs P or E");
  }
  const double mode = std::round(words.value_or('L', 0));
  const bool waits = mode > 0;
  if (mode < 0 || mode > 4 || (words.has('E') && waits) || (waits && words.value_or('Q', 0) <= 0)) {
    return run.fail_word(ErrorCode::IoWords, 'L', "M66");
  }
  return words.has('P') ? read_digital(run, static_cast<InputWait>(mode)) : read_analog(run);
}

bool select_tool(Run& run) {
  const double number = run.block.words['T'];
  if (!run.is_linuxcnc() && number > run.options.slots) {
    return run.fail_word(ErrorCode::SlotRange, 'T',
                         fmt::format("T{} is above {}", number, run.options.slots));
  }
  if (run.is_linuxcnc() && !is_known_tool(run, number)) {
    return run.fail_word(ErrorCode::ToolNotFound, 'T', fmt::format("T{}", number));
  }
  run.state.tool.selected = static_cast<int>(std::fmin(number, 1e9));
  run.events().on_tool({run.origin, run.state.tool.selected, true, {}});
  return true;
}

void change_state_stack(Run& run, int code) {
  SavedModes& saved = run.state.calls.empty() ? run.state.saved : run.state.calls.back().modes;
  if (code == 71) {
    saved.is_valid = false;
    return;
  }
  save_modes(run, saved);
  saved.restores_at_return = code == 73;
}

bool apply_state_code(Run& run, int code) {
  if (code != 72) {
    change_state_stack(run, code);
    return true;
  }
  const SavedModes& saved =
      run.state.calls.empty() ? run.state.saved : run.state.calls.back().modes;
  if (!saved.is_valid) return run.fail(ErrorCode::StateStack, 0, "M72");
  return restore_modes(run, SavedModes{saved});
}

/// M100 to M199, programs of the shop, with their words.
void hand_on(Run& run, int code) {
  const Words& words = run.block.words;
  Miscellaneous event{run.origin, code};
  if (words.has('P')) event.p = words['P'];
  if (words.has('Q')) event.q = words['Q'];
  run.events().on_miscellaneous(event);
}

/// M3, M4, M5, M19.
bool apply_spindle_code(Run& run, int code) {
  if (code == 19) return orient(run);
  const auto state = code == 3   ? SpindleState::Clockwise
                     : code == 4 ? SpindleState::Counterclockwise
                                 : SpindleState::Off;
  const bool commands_again = run.is_linuxcnc() || run.block.words.has('S');
  if (run.state.spindle.state == state && commands_again && code != 5) show_spindle(run);
  turn_spindle(run, state);
  return true;
}

}  // namespace

void turn_spindle(Run& run, SpindleState state) {
  if (run.state.spindle.state == state) return;
  run.state.spindle.state = state;
  show_spindle(run);
}

bool apply_spindle_mode(Run& run) {
  const int code = run.block.g(GGroup::SpindleMode);
  if (code < 0) return true;
  const Words& words = run.block.words;
  SpindleModes& spindle = run.state.spindle;
  if (code == 970) {
    spindle.is_surface = false;
    return true;
  }
  if (!words.has('S') || words.value_or('D', 0) < 0) {
    return run.fail(ErrorCode::SpindleMode, 0, "G96 needs S");
  }
  spindle.is_surface = true;
  spindle.most = words.value_or('D', SpindleModes::kNoLimit);
  return true;
}

bool apply_speed_and_tool(Run& run) {
  const Words& words = run.block.words;
  if (words.has('S')) {
    SpindleModes& spindle = run.state.spindle;
    // LinuxCNC's G96, G97 and units reach a turning spindle with its next S, M3 or M4.
    const bool changes = run.is_linuxcnc() || spindle.speed != words['S'];
    spindle.speed = words['S'];
    // A spindle that this line starts shows its speed then.
    const int code = run.block.m(MGroup::Spindle);
    if (changes && spindle.is_turning() && (code < 3 || code > 5)) show_spindle(run);
  }
  return !words.has('T') || select_tool(run);
}

bool apply_inputs(Run& run) {
  const int code = run.block.m(MGroup::InputOutput);
  if (code < 0) return true;
  if (!is_allowed_now(run, code)) return false;
  if (code == 66) return read_input(run);
  return code < 66 ? switch_output(run, code) : write_output(run, code);
}

bool apply_machine_functions(Run& run) {
  const Block& block = run.block;
  if (const int code = block.m(MGroup::Tool); code >= 0 && !change_tool(run, code)) return false;
  if (const int code = block.m(MGroup::Spindle); code >= 0) {
    if (!(code >= 70 ? apply_state_code(run, code) : apply_spindle_code(run, code))) return false;
  }
  if (const int code = block.m(MGroup::Coolant); code >= 0) apply_coolant(run, code);
  if (const int code = block.m(MGroup::Override); code >= 0 && !apply_override(run, code)) {
    return false;
  }
  if (const int code = block.m(MGroup::User); code >= 0) hand_on(run, code);
  return true;
}

OverrideInhibit override_inhibit(const Run& run) {
  const Overrides& overrides = run.state.overrides;
  OverrideInhibit lock{.origin = run.origin};
  lock.feed_override = !overrides.feed;
  lock.spindle_override = !overrides.speed;
  if (!overrides.hold) lock.hold = FeedHoldInhibit::Later;
  return lock;
}

bool reset_at_end(Run& run) {
  State& state = run.state;
  if (!check_nurbs_closed(run) || !switch_compensation(run, 400)) return false;
  state.compensation = Compensation{};
  reset_coordinates(run);
  state.modes.plane = Plane::XY;
  state.modes.has_tilted_plane = false;
  state.modes.is_incremental = false;
  state.modes.feed = FeedMode::PerMinute;
  state.modes.motion = 10;
  state.overrides = Overrides{};
  if (run.is_linuxcnc()) {
    state.feed = 0;
    state.has_lost_lead = false;
    state.spindle.is_surface = false;
  }
  if (state.spindle.state != SpindleState::Off) turn_spindle(run, SpindleState::Off);
  apply_coolant(run, 9);
  return true;
}

namespace {

/// M30 and M60 exchange pallets; LinuxCNC knows none, and M30 is the end without them too.
void exchange_pallets(Run& run, int code) {
  run.events().on_miscellaneous(
      {.origin = run.origin, .code = code, .is_done = code == 30 || run.is_linuxcnc()});
}

}  // namespace

bool apply_stops(Run& run) {
  const int code = run.block.m(MGroup::Stop);
  EventSink& events = run.events();
  if (code == 0 || code == 60 || (code == 1 && run.options.optional_stop)) run.state.passes = 0;
  switch (code) {
    case 0:
      events.on_stop({run.origin, StopKind::Program});
      return true;
    case 1:
      if (run.options.optional_stop) events.on_stop({run.origin, StopKind::Optional});
      return true;
    case 60:
      exchange_pallets(run, code);
      events.on_stop({run.origin, StopKind::Program});
      return true;
    case 2:
    case 30:
      if (!reset_at_end(run)) return false;
      if (code == 30) exchange_pallets(run, code);
      run.state.phase = RunPhase::Ended;
      return true;
    default:
      return true;
  }
}

}  // namespace dripline::interpreter::rs274ngc
