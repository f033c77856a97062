#include "gateway/interpreter/dialects/rs274ngc/startup_code.hpp"

#include <algorithm>
#include <array>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/dialects/rs274ngc/interpreter.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

class AlarmText final : public EventSink {
 public:
  void on_alarm(const Alarm& alarm) override {
    text = fmt::format("{} {}", alarm.diagnostic.id, alarm.diagnostic.text);
  }
  std::string text;
};

/// What M2 of LinuxCNC ends.
struct EndedMode {
  std::string_view name;
  bool (*is_on)(const State& state);
};
constexpr std::array kEnded{
    EndedMode{"G91", [](const State& s) { return s.modes.is_incremental; }},
    EndedMode{"G93", [](const State& s) { return s.modes.feed == FeedMode::InverseTime; }},
    EndedMode{"G95", [](const State& s) { return s.modes.feed == FeedMode::PerRevolution; }},
    EndedMode{"a work system other than G54", [](const State& s) { return s.system != 1; }},
    EndedMode{"G41 and G42", [](const State& s) { return s.compensation.side != Side::Off; }},
    EndedMode{"G96", [](const State& s) { return s.spindle.is_surface; }},
    EndedMode{"a spindle that turns", [](const State& s) { return s.spindle.is_turning(); }},
    EndedMode{"coolant", [](const State& s) { return s.flood || s.mist; }},
    EndedMode{"an inhibited override (M49, M50 P0, M51 P0)",
              [](const State& s) { return !s.overrides.feed || !s.overrides.speed; }}};

/// All but the modes of `apply_startup_code` as at power on.
State without_taken_modes(const State& after, const State& before) {
  State state = after;
  state.phase = before.phase;
  state.has_header = before.has_header;
  state.demarcation = before.demarcation;
  state.blocks = before.blocks;
  state.at = before.at;
  state.sequence = before.sequence;
  state.units = before.units;
  state.feed = before.feed;
  state.feed_units = before.feed_units;
  state.overrides = before.overrides;  // M52 and M53: see machine_functions
  state.spindle.speed = before.spindle.speed;
  const bool has_tilted_plane = state.modes.has_tilted_plane;
  state.modes = before.modes;
  state.modes.has_tilted_plane = has_tilted_plane;
  return state;
}

}  // namespace

Result<void> apply_startup_code(const ControlOptions& options, State& state) {
  const std::string& code = options.startup_code;
  if (code.empty()) return {};
  if (code.find_first_of("\r\n") != std::string::npos)
    return fail(Errc::Syntax, "[control] startup_code: more than one line");
  ControlOptions as_startup = options;
  as_startup.profile = Profile::LinuxCnc;
  as_startup.startup_code.clear();
  as_startup.is_mdi = true;
  as_startup.block_skip = false;
  const std::string text = code + "\n";
  State before;
  before.units = state.units;
  const auto parameters = std::make_unique<Parameters>();
  parameters->fill(0);
  (*parameters)[kSystemNumber] = 1;
  MemorySource source(text);
  AlarmText alarm;
  Rs274NgcInterpreter line(as_startup, {}, before, *parameters, source, alarm);
  const Snapshot at_power_on = line.snapshot();
  StepState step = StepState::Ran;
  while (step == StepState::Ran) step = line.step(1);
  if (step == StepState::Alarmed)
    return fail(Errc::Syntax, "[control] startup_code \"{}\": {}", code, alarm.text);
  if (step != StepState::Ended)
    return fail(Errc::Unsupported, "[control] startup_code \"{}\": it asks the machine", code);
  const State after = line.state();
  for (const EndedMode& mode : kEnded) {
    if (mode.is_on(after))
      return fail(Errc::Unsupported,
                  "[control] startup_code \"{}\": {} would be in force until the first M2 only",
                  code, mode.name);
  }
  line.begin_with(without_taken_modes(after, before));
  if (line.snapshot().bytes != at_power_on.bytes)
    return fail(
        Errc::Unsupported,
        "[control] startup_code \"{}\": it does more than set modes, so that programs depend "
        "on it",
        code);
  if (!options.is_linuxcnc() && (after.modes.is_diameter || after.modes.is_arc_absolute))
    return fail(Errc::Unsupported,
                "[control] startup_code \"{}\": the profile nist has neither G7 nor G90.1", code);
  state.units = after.units;
  state.spindle.speed = after.spindle.speed;
  state.modes.plane = after.modes.plane;
  state.modes.is_arc_absolute = after.modes.is_arc_absolute;
  state.modes.retracts_to_start = after.modes.retracts_to_start;
  state.modes.is_diameter = after.modes.is_diameter;
  state.modes.path = after.modes.path;
  state.modes.path_tolerance = after.modes.path_tolerance;
  state.modes.cam_tolerance = after.modes.cam_tolerance;
  return {};
}

}  // namespace dripline::interpreter::rs274ngc
