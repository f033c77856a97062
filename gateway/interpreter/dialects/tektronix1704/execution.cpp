#include "gateway/interpreter/dialects/tektronix1704/execution.hpp"

#include <fmt/format.h>
#include <string>

#include "gateway/interpreter/dialects/tektronix1704/machine_functions.hpp"
#include "gateway/interpreter/dialects/tektronix1704/motion.hpp"
#include "gateway/interpreter/dialects/tektronix1704/path_rules.hpp"

namespace dripline::interpreter::tektronix1704 {
namespace {

/// What a G word asks of its block besides a mode.
enum class OneShot : std::uint8_t { None, Dwell, Preset };

struct GFunction {
  bool is_fitted = false;
  OneShot one_shot = OneShot::None;
};

bool fits_motion(Run& run, Motion motion) {
  run.state.motion = motion;
  return !is_arc(motion) || run.options.has_arcs;
}

bool enter_cycle(Run& run, int code) {
  run.state.motion = Motion::Cycle;
  run.state.cycle = static_cast<std::uint8_t>(code);
  return run.options.has_cycles && (code == 80 || run.options.axes == kAxes);
}

/// Sets the mode a G word names.
GFunction apply_g(Run& run, int code) {
  State& state = run.state;
  switch (code) {
    case 0:
      return {fits_motion(run, Motion::G00)};
    case 1:
      return {fits_motion(run, Motion::G01)};
    case 2:
      return {fits_motion(run, Motion::G02)};
    case 3:
      return {fits_motion(run, Motion::G03)};
    case 4:
      return {run.options.has_dwell, OneShot::Dwell};
    case 20:
      return {fits_motion(run, Motion::G20)};
    case 30:
      return {fits_motion(run, Motion::G30)};
    case 50:
      return {fits_motion(run, Motion::G50)};
    case 90:
    case 91:
      state.is_incremental = code == 91;
      return {true};
    case 94:
      return {true, OneShot::Preset};
    case 98:
    case 99:
      state.drills = code == 99;
      return {run.options.has_quill && run.options.axes == 2};
    default:
      return {code >= 80 && code <= 89 && enter_cycle(run, code)};
  }
}

/// No motion: the present place becomes zero, of the axes named or of all (manual: G94).
void preset(Run& run) {
  State& state = run.state;
  const Words& words = state.block.words;
  const bool names_axes = words.has_any(kEndWords);
  for (std::size_t axis = 0; axis < run.options.axes; ++axis) {
    const auto address = static_cast<Address>(static_cast<std::size_t>(Address::X) + axis);
    if (names_axes && !words.has(address)) continue;
    if (names_axes && words[address] != 0) {
      run.warn(Fault::PresetValue, run.origin, 0, fmt::format("{}", words[address]));
    }
    state.origin[axis] += run.options.mirror[axis] ? -state.program[axis] : state.program[axis];
    state.is_center_old[axis] |= state.program[axis] != 0;
    state.program[axis] = 0;
  }
  run.ledger.take(kEndWords);
}

/// F is tenths of a second here and leaves the feedrate alone (manual: G04).
bool dwell(Run& run) {
  const Words& words = run.state.block.words;
  constexpr int kLongest = 999;
  constexpr double kSecondsPerCount = 0.1;
  if (!words.has(Address::F)) return run.fail(Fault::DwellWithoutF);
  const int count = words[Address::F];
  if (count < 1 || count > kLongest) {
    return run.fail(Fault::DwellTooLong, 0, fmt::format("F{} is not 1 to {}", count, kLongest));
  }
  if (!check_stop(run)) return false;
  run.events().on_dwell({run.origin, count * kSecondsPerCount, std::nullopt});
  return true;
}

bool is_alone(const Words& words) {
  constexpr std::uint16_t kOfDwell = bit(Address::N) | bit(Address::G) | bit(Address::F);
  return (words.present() & ~kOfDwell) == 0;
}

bool move_and_drill(Run& run) {
  const auto before = run.state.program;
  if (!move_block(run)) return false;
  if (run.state.drills && run.state.program != before) [[unlikely]]
    stroke_quill(run);
  return true;
}

bool execute_motion(Run& run, OneShot one_shot) {
  switch (one_shot) {
    case OneShot::Preset:
      preset(run);
      return true;
    case OneShot::Dwell:
      if (!is_alone(run.state.block.words)) {
        if (!run.object(Fault::DwellNotAlone) || !move_and_drill(run)) return false;
      }
      return dwell(run);
    case OneShot::None:
      break;
  }
  return move_and_drill(run);
}

/// What has led to nothing: an axis word stops the tape.
[[gnu::cold, gnu::noinline]] bool report_left_words(Run& run) {
  const Words& words = run.state.block.words;
  const std::string text = language::listed(run.ledger.left(), [&](std::size_t i) {
    return fmt::format("{}{}", kLetters[i], words[static_cast<Address>(i)]);
  });
  if ((run.ledger.left() & kEndWords) != 0) return run.fail(Fault::Unused, 0, text);
  run.warn(Fault::Unused, run.origin, 0, text);
  return true;
}

}  // namespace

bool execute_block(Run& run) {
  State& state = run.state;
  const Words& words = state.block.words;
  run.ledger.open(words.present() & (kEndWords | kCenterWords));
  if (run.options.units == UnitSet::Option1) [[unlikely]]
    round_to_steps(run);
  GFunction function{true};
  if (words.has(Address::G)) {
    function = apply_g(run, words[Address::G]);
    if (!function.is_fitted) {
      return run.fail(Fault::GCode, 0, fmt::format("G{:02}", words[Address::G]));
    }
  }
  const bool is_dwell = function.one_shot == OneShot::Dwell;
  if (words.has(Address::F) && !is_dwell && !load_feed(run, words[Address::F])) return false;
  load_codes(run);
  if (words.has_any(kCenterWords)) load_center(run);
  if (words.has(Address::R)) load_clearance(run);
  if (!do_m_before(run) || !execute_motion(run, function.one_shot)) return false;
  if (run.ledger.left() != 0 && !report_left_words(run)) return false;
  return do_m_after(run);
}

}  // namespace dripline::interpreter::tektronix1704
