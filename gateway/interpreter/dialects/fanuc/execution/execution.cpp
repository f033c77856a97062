#include "gateway/interpreter/dialects/fanuc/execution/execution.hpp"

#include <fmt/format.h>
#include <bit>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/dialects/fanuc/compensation/cutter_compensation.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/coordinates.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/flow.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/machine_functions.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/measuring.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/rotary_plane.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/statements.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/length_in_axes.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/parameters.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/tool_offsets.hpp"
#include "gateway/interpreter/dialects/fanuc/tilting/tilting.hpp"
#include "gateway/interpreter/dialects/fanuc/turning/turning.hpp"

namespace dripline::interpreter::fanuc {
namespace {

bool change_units(Run& run) {
  ModalState& state = run.state;
  const Units units = state.g[kUnitsGroup] == 20 ? Units::Inch : Units::Millimeter;
  if (units == state.units) return true;
  if (state.is_compensating()) {
    return run.fail(ErrorCode::ImproperCommand, run.block.parts.g_column,
                    "the units change in cutter compensation");
  }
  state.units = units;
  run.update_increments();
  if (state.has_header) run.events().on_units({run.origin, units});
  return true;
}

/// A group 01 and a group 09 code end or begin the mode of hole cycles; of both the later counts.
void apply_motion_groups(Run& run) {
  Block& block = run.block;
  ModalState& state = run.state;
  const bool names_cycle = block.names(kCycleGroup);
  const bool names_motion = block.names(kMotionGroup);
  const bool ends_cycle = names_cycle && block.g[kCycleGroup] == 80;
  if (names_motion &&
      (!names_cycle || ends_cycle || block.parts.last_motion_group == kMotionGroup)) {
    state.g[kMotionGroup] = block.g[kMotionGroup];
    state.g[kCycleGroup] = 80;
    state.is_rigid_tapping = false;
    const std::uint8_t motion = state.g[kMotionGroup];
    if (motion < kBoxTurning || motion > kBoxFacing) state.box.code = 0;
    return;
  }
  if (!names_cycle) return;
  const bool was_on = state.is_cycle();
  state.g[kCycleGroup] = block.g[kCycleGroup];
  if (ends_cycle) state.is_rigid_tapping = false;
  block.parts.begins_cycle = !was_on && state.is_cycle();
}

/// Codes that only set what later words mean.
bool apply_modes(Run& run) {
  const Block& block = run.block;
  ModalState& state = run.state;
  constexpr std::uint32_t kPlain = 1u << kDistanceGroup | 1u << kFeedGroup | 1u << kReturnGroup |
                                   1u << kSpindleGroup | 1u << kPathGroup | 1u << kUnitsGroup |
                                   1u << kPolarGroup;
  // What a control makes of the number under another mode is not known: F comes again.
  if (block.names(kFeedGroup) && block.g[kFeedGroup] != state.g[kFeedGroup]) state.feed = {};
  for (std::uint32_t left = block.parts.groups & kPlain; left != 0; left &= left - 1) {
    const auto group = static_cast<std::size_t>(std::countr_zero(left));
    state.g[group] = block.g[group];
  }
  if (block.names(kUnitsGroup) && !change_units(run)) return false;
  if (block.names(kPathGroup)) show_override_inhibit(run);
  const bool changes_plane =
      block.names(kPlaneGroup) && state.g[kPlaneGroup] != block.g[kPlaneGroup];
  if (block.names(kPolarGroup) || changes_plane) {
    state.polar_angle = 0;
    state.polar_radius.reset();
  }
  if (changes_plane) {
    if (state.is_compensating())
      return run.fail(ErrorCode::PlaneInCompensation, block.parts.g_column);
    if (state.g[kRotationGroup] == 68 &&
        !(block.names(kRotationGroup) && block.g[kRotationGroup] == 69)) {
      return run.fail(ErrorCode::RotationPlane, block.parts.g_column);
    }
    // Z of the holes before would become the depth along another axis.
    if (state.is_cycle() && !block.parts.begins_cycle) {
      return run.fail(ErrorCode::IllegalPlane, block.parts.g_column,
                      "a hole cycle is canceled before its axis changes");
    }
    state.g[kPlaneGroup] = block.g[kPlaneGroup];
  }
  const std::uint8_t motion =
      block.names(kMotionGroup) ? block.g[kMotionGroup] : state.g[kMotionGroup];
  const bool is_thread = motion == 33 || motion == kVariableThread || motion == kBoxThread ||
                         block.parts.one_shot == kTurningCycles + 6;
  if (is_thread) {
    if (!apply_lead(run)) return false;
  } else if (!apply_feed(run)) {
    return false;
  }
  return apply_speed(run);
}

/// Coordinates, transformations, offsets.
bool apply_frames(Run& run) {
  const Block& block = run.block;
  if (block.names(kWorkGroup) && !select_work_system(run)) return false;
  if (block.names(kStrokeGroup) && !set_stroke_zone(run)) return false;
  if (!apply_transformations(run)) return false;
  if (!apply_length_offset(run)) return false;
  if (!apply_compensation(run)) return false;
  // Its level is one of the plane and the coordinates that the block itself selects.
  if (block.parts.begins_cycle) begin_cycle_mode(run);
  return true;
}

/// Whether the axis words of the block are data, not a move.
bool words_are_data(const Block& block) {
  return (block.names(kStrokeGroup) && block.g[kStrokeGroup] == 22) ||
         (block.names(kScalingGroup) && block.g[kScalingGroup] == 51) ||
         (block.names(kRotationGroup) && block.g[kRotationGroup] != 69) ||
         block.names(kMirrorGroup);
}

bool dwell(Run& run) {
  const Words& words = run.block.words;
  double seconds = 0;
  std::uint32_t column = 0;
  if (words.has(P) && words.has_any(set_of(X, U))) {
    return run.fail(ErrorCode::ImproperCommand, words.column(P), "G04 takes X or P, not both");
  }
  if (words.has(X) || words.has(U)) {
    const Word& word = words[words.has(X) ? X : U];
    run.ledger.take(set_of(words.has(X) ? X : U));
    const bool counts = word.form == WordForm::Whole && !run.options.calculator_point;
    seconds = counts ? word.value / 1000 : word.value;
    column = word.column;
  } else if (words.has(P)) {
    seconds = run.whole(words[P]) / 1000;
    column = words.column(P);
  }
  if (!(seconds >= 0 && seconds <= 99999.999)) {
    return run.fail(seconds < 0 ? ErrorCode::NegativeSign : ErrorCode::TooManyDigits, column);
  }
  if (seconds > 0) {
    run.state.limits = {};
    run.events().on_dwell({run.origin, seconds, {}});
  }
  return true;
}

/// G07: 0 makes an axis imaginary, anything else makes it real again.
bool set_imaginary(Run& run) {
  ModalState& state = run.state;
  for (const Axis axis : kAllAxes) {
    const AddressSet set = set_of_axis(axis);
    if (!run.block.words.has_any(set)) continue;
    run.ledger.take(set);
    const auto i = static_cast<std::size_t>(axis);
    const auto address = static_cast<Address>(std::countr_zero(set));
    const bool was_on = (state.imaginary >> i & 1u) != 0;
    const bool is_on = run.block.words[address].value == 0;
    if (is_on && !was_on) state.held[i] = state.position.raw(axis);
    if (!is_on && was_on) state.position.set_raw(axis, state.held[i]);
    state.imaginary = static_cast<std::uint16_t>(is_on ? state.imaginary | 1u << i
                                                       : state.imaginary & ~(1u << i));
  }
  return true;
}

bool execute_one_shot(Run& run) {
  Block& block = run.block;
  if (block.parts.one_shot != 4) run.state.box.code = 0;  // the manual: other codes clear its data
  switch (block.parts.one_shot) {
    case 4:
      return dwell(run);
    case 5:
    case 8:
    case kContourControl:
      return set_look_ahead(run);
    case 7:
      return set_imaginary(run);
    case 10:
      return set_data(run);
    case 11:
      run.state.enters_parameters = false;
      return true;
    case 27:
    case 28:
    case 29:
    case 30:
      block.parts.has_motion = block.words.has_any(kAxisWords);
      if (!execute_reference(run)) return false;
      resume_compensation(run);
      return true;
    case 31:
      block.parts.has_motion = block.words.has_any(kAxisWords);
      if (run.state.is_cycle())
        return run.fail(ErrorCode::HomeInCycle, block.parts.g_column, "G31");
      return start_skip(run);
    case 37:
      block.parts.has_motion = true;
      return start_measuring(run);
    case kTurningCycles:
    case kTurningCycles + 1:
    case kTurningCycles + 2:
    case kTurningCycles + 3:
    case kTurningCycles + 4:
    case kTurningCycles + 5:
    case kTurningCycles + 6:
      return execute_turning_cycle(run);
    case kCylinder:
      return set_cylinder(run);
    case kPresetCoordinates:
      return preset_coordinates(run);
    case 39:
      run.ledger.take(kCenterWords);
      return round_corner(run);
    case 52:
      return set_local_zero(run);
    case kAxisDirection:
      return direct_tool_axis(run);
    case 53:
      block.parts.has_motion = block.words.has_any(kAxisWords);
      interrupt_compensation(run);
      if (!move_in_machine_coordinates(run)) return false;
      resume_compensation(run);
      return true;
    default:
      return set_position(run);  // 92
  }
}

/// G09, G45 to G48 and G60 only change the move of their block.
bool is_data_code(std::uint8_t one_shot) {
  return one_shot != Block::kNoCode && one_shot != 9 && one_shot != 60 &&
         (one_shot < 45 || one_shot > 48);
}

/// Corner words shape the end of a feed move in the plane.
bool check_corner(Run& run) {
  const Block& block = run.block;
  const std::uint8_t motion = run.state.g[kMotionGroup];
  const std::uint8_t one_shot = block.parts.one_shot;
  const PlaneAxes axes = axes_of(run.state.plane());
  const AddressSet in_plane = set_of_axis(axes.first) | set_of_axis(axes.second);
  const bool is_feed = motion >= 1 && motion <= 3 && !run.state.is_cycle() &&
                       (one_shot == Block::kNoCode || one_shot == 9) && !words_are_data(block) &&
                       block.words.has_any(in_plane | kCenterWords);
  if (is_feed) return true;
  return run.fail(ErrorCode::CornerOfNoMove, block.parts.corner_column,
                  "a corner word needs a move by G01, G02 or G03 in the plane");
}

/// Whether U, V, W and H lead somewhere; elsewhere they are data.
bool has_increments(const Block& block) {
  const std::uint8_t one_shot = block.parts.one_shot;
  const bool is_cycle = one_shot >= kTurningCycles && one_shot <= kTurningCycles + 6;
  return one_shot != 4 && one_shot != 10 && !is_cycle;
}

/// I, K and R beside G00 and G01 are corners of older lathes: without them the tool goes elsewhere.
bool check_old_corners(Run& run) {
  const Block& block = run.block;
  constexpr AddressSet kOldCorners = kCenterWords | set_of(R);
  const bool is_line = run.state.g[kMotionGroup] <= 1 && !run.state.is_cycle();
  if (!is_line || block.parts.one_shot != Block::kNoCode || words_are_data(block) ||
      !block.words.has_any(kOldCorners)) {
    return true;
  }
  return run.fail(ErrorCode::ImproperCommand, block.words.first_column(kOldCorners),
                  "corners are written ,R and ,C");
}

/// Data are no move, and G53 is in machine coordinates.
bool moves_in_program(const Block& block) {
  const std::uint8_t one_shot = block.parts.one_shot;
  const bool is_reference = one_shot >= 27 && one_shot <= 31;
  const bool is_cycle = one_shot >= kTurningCycles && one_shot <= kTurningCycles + 6;
  return !words_are_data(block) &&
         (!is_data_code(one_shot) || is_reference || is_cycle || one_shot == 37);
}

bool execute_motion(Run& run) {
  Block& block = run.block;
  if (block.names(kInterpolationGroup)) return set_polar_plane(run);
  if (run.options.is_lathe) {
    if (has_increments(block) && !resolve_increments(run)) return false;
    if (!check_old_corners(run)) return false;
  }
  if (block.parts.corner != CornerKind::None && (!check_corner(run) || !announce_corner(run)))
    return false;
  run.state.length_in_axes.is_even = false;
  if (moves_in_program(block)) note_programmed_axes(run);
  if (is_data_code(block.parts.one_shot)) return execute_one_shot(run);
  if (words_are_data(block)) {
    take_data_words(run);
    return true;
  }
  if (run.state.is_cycle()) {
    block.parts.has_motion = block.words.has_any(kAxisWords | set_of(R));
    return execute_cycle(run);
  }
  block.parts.has_motion = block.words.has_any(kAxisWords | kCenterWords);
  return move(run);
}

bool execute_nc(Run& run) {
  Block::Parts& parts = run.block.parts;
  run.state.inverse_feed = 0;
  if (parts.stage == Stage::Execution) {
    if (run.state.contour.code != 0 && !check_contour_block(run)) return false;
    if (const Answer* answer = run.next_answer()) {
      const auto& result = std::get<ProbeResult>(*answer);
      const bool is_measuring = run.block.parts.one_shot == 37;
      if (is_measuring && !finish_measuring(run, result)) return false;
      if (!is_measuring) finish_skip(run, result);
    } else if (run.state.enters_parameters && run.block.parts.one_shot != 11) {
      if (!enter_parameter(run)) return false;
    } else {
      if (run.rotary.is_on() && !check_rotary_block(run)) return false;
      if (run.tilted.is_on() && !check_tilted_block(run)) return false;
      apply_motion_groups(run);
      if (!apply_modes(run) || !apply_before_motion(run) || !apply_frames(run)) return false;
      if (!execute_motion(run)) return false;
      if (run.tilted.is_on() && !take_length_offset(run)) return false;
      if (!check_last_stage(run)) return false;
    }
    run.update_special();
    parts.stage = Stage::AfterMove;
  }
  if (run.block.names(kModalCallGroup) && run.block.g[kModalCallGroup] == 67)
    cancel_modal_call(run);
  if (parts.m_count == 0) [[likely]]
    return plan_modal_call(run);
  return apply_after_motion(run) && plan_flow_of_m_codes(run) && plan_modal_call(run);
}

/// The codes before G65 and G66 act; the rest are arguments.
bool execute_call(Run& run) {
  run.block.parts.one_shot = Block::kNoCode;
  if (run.tilted.is_on() && !check_tilted_block(run)) return false;
  apply_motion_groups(run);
  if (!apply_modes(run) || !apply_before_motion(run) || !apply_frames(run)) return false;
  if (run.tilted.is_on() && (!take_length_offset(run) || !check_last_stage(run))) return false;
  run.update_special();
  return plan_macro_call(run);
}

}  // namespace

void open_ledger(Run& run) {
  constexpr AddressSet kOwed = kAxisWords | kCenterWords | set_of(L, Q, R);
  const bool has_data = run.block.parts.kind == BlockKind::Nc;
  run.ledger.open(has_data ? run.block.words.present() & kOwed : 0);
}

bool report_left_words(Run& run) {
  const auto left = static_cast<AddressSet>(run.ledger.left());
  const std::string text = language::listed(left, [&](std::size_t i) {
    const auto address = static_cast<Address>(i);
    return fmt::format("{}{}", letter(address), run.block.words[address].value);
  });
  const std::uint32_t column = run.block.words.first_column(left);
  if ((left & kAxisWords) != 0) return run.fail(ErrorCode::UnusedAxis, column, text);
  if (run.options.is_lathe) {  // most of these shape a cut on one lathe or another
    return run.fail(ErrorCode::ImproperCommand, column, fmt::format("{} has no use here", text));
  }
  run.warn(WarningCode::UnusedWord, column, text);
  return true;
}

bool execute_block(Run& run) {
  switch (run.block.parts.kind) {
    case BlockKind::Nc:
      return execute_nc(run);
    case BlockKind::Macro:
      return execute_statement(run);
    case BlockKind::Call:
      break;
  }
  return execute_call(run);
}

}  // namespace dripline::interpreter::fanuc
