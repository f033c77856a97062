#include "gateway/interpreter/dialects/rs274ngc/execution/execution.hpp"

#include <fmt/format.h>

#include "gateway/interpreter/dialects/rs274ngc/cycles/cycles.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/coordinates.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/machine_functions.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/motion.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/splines.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/comments.hpp"
#include "gateway/interpreter/dialects/rs274ngc/turning/turning.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

bool before_machine(Run& run) {
  const Block& block = run.block;
  if (block.setting_count != 0) apply_settings(run);
  if (block.comment_begin != nullptr && !execute_comment(run)) return false;
  if (!apply_spindle_mode(run) || !apply_feed(run)) return false;
  return !block.words.has_any(set_of("ST")) || apply_speed_and_tool(run);
}

bool execute_one_shots(Run& run) {
  const int code = run.block.g(GGroup::OneShot);
  if (code == 280 || code == 300) {
    run.ledger.take_all();
    return home_move(run, code);
  }
  if (code == 40 || code == 530) return true;
  return execute_one_shot(run, code);
}

bool dwell(Run& run) {
  if (run.block.g(GGroup::OneShot) != 40) return true;
  if (run.block.words['P'] > 0) run.state.passes = 0;
  run.events().on_dwell({run.origin, run.block.words['P'], {}});
  return true;
}

bool execute_motion_code(Run& run, int code) {
  switch (code) {
    case 0:
    case 10:
      return straight_move(run, code);
    case 20:
    case 30:
      return arc_move(run, code == 20);
    case 50:
    case 51:
      return spline_move(run, code);
    case 52:
      return add_control_point(run);
    case 53:
      return make_nurbs(run);
    case 330:
    case 331:
      return synchronized_move(run, code);
    case 760:
      return thread_cycle(run);
    case 800:
      return true;
    default:
      if (is_turning_cycle(code)) return begin_turning(run);
      return is_probe(code) ? probe_move(run, code) : execute_cycle(run, code);
  }
}

/// G0 to G3 use every axis word: their lines need no account.
bool is_line_or_arc(int motion) {
  return motion >= 0 && motion <= 30;
}

bool execute_motion(Run& run) {
  const int code = run.block.motion;
  if (code < 0) return true;
  State& state = run.state;
  const bool keeps_series = is_cycle(code);
  if (!keeps_series) {
    state.cycle.is_series = false;
    if (!is_line_or_arc(code)) run.ledger.take_all();  // one that cannot use a word refuses it
  }
  if (code != 50) state.follows_spline = false;
  if (!execute_motion_code(run, code)) return false;
  // After a spline a line without a code continues the motion mode before it.
  if (code != 50 && code != 51 && !is_turning_cycle(code))
    state.modes.motion = static_cast<std::int16_t>(run.block.motion);
  return true;
}

[[gnu::cold, gnu::noinline]] bool refuse_left_words(Run& run) {
  const auto left = static_cast<AddressSet>(run.ledger.left());
  const std::string words = language::listed(left, [&](std::size_t i) {
    const char word = letter_of(static_cast<Address>(i));
    return fmt::format("{}{}", word, run.block.words[word]);
  });
  return run.fail_word(ErrorCode::UnusedAxis, words.front(), words);
}

}  // namespace

void apply_settings(Run& run) {
  const Block& block = run.block;
  for (std::uint8_t i = 0; i < block.setting_count; ++i) {
    const Setting& setting = block.settings[i];
    if (setting.index >= 0) {
      run.parameters[static_cast<std::size_t>(setting.index)] = setting.value;
    } else {
      run.names.set(static_cast<NameId>(-1 - setting.index), run.state.calls.size(), setting.value);
    }
  }
}

bool execute_line(Run& run) {
  Block& block = run.block;
  if (block.stage == Stage::Before) {
    if (!is_line_or_arc(block.motion))
      run.ledger.open(block.words.present() & (kAxisWords | kPolarWords));
    if (!before_machine(run)) return false;
    block.stage = Stage::Input;
  }
  if (block.stage == Stage::Input) {
    if (block.m_groups != 0 && !apply_inputs(run)) return false;
    block.stage = Stage::Machine;
  }
  if (block.stage == Stage::Machine) {
    if (block.m_groups != 0 && !apply_machine_functions(run)) return false;
    if (block.g_groups != 0) {
      if (!run.state.nurbs.points.empty() && !fits_in_nurbs(run)) [[unlikely]]
        return false;
      if (!dwell(run) || !apply_modes(run)) return false;
      if (block.has(GGroup::OneShot) && !execute_one_shots(run)) return false;
    }
    block.stage = Stage::Motion;
  }
  if (block.stage == Stage::Motion) {
    if (!execute_motion(run)) return false;
    if (run.ledger.left() != 0) [[unlikely]]
      return refuse_left_words(run);
    block.stage = Stage::After;
  }
  return !block.has(MGroup::Stop) || apply_stops(run);
}

}  // namespace dripline::interpreter::rs274ngc
