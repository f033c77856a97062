#include "gateway/interpreter/dialects/centurion/codes/execution.hpp"

#include <fmt/format.h>

#include "gateway/interpreter/dialects/centurion/codes/g_functions.hpp"
#include "gateway/interpreter/dialects/centurion/codes/machine_functions.hpp"
#include "gateway/interpreter/dialects/centurion/codes/reference_points.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/box_cycles.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/drilling_cycles.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/groove_cycles.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/pattern_cycles.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/threads.hpp"
#include "gateway/interpreter/dialects/centurion/flow/flow.hpp"
#include "gateway/interpreter/dialects/centurion/flow/macro_calls.hpp"
#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"
#include "gateway/interpreter/dialects/centurion/reading/join_words.hpp"

namespace dripline::interpreter::centurion {
namespace {

/// G65 without P: the program and compensation go on, the machine stays.
bool suppressed_move(Run& run) {
  suppress_output(run, true);
  const bool is_done = move(run);
  suppress_output(run, false);
  return is_done;
}

/// Drills and grooving tools have no use for compensation (spec 9.4).
bool run_aside(Run& run, bool (*cycle)(Run&)) {
  if (run.parameters[kNoCannedCycles] != 0) {
    const GRow& row = g_row(run.block.parts.action);
    return run.fail(ErrorCode::UndefinedCycle, 0,
                    fmt::format("G{}: the canned cycles are not loaded", row.code));
  }
  leave_compensation(run);
  const bool is_done = cycle(run);
  resume_compensation(run);
  return is_done;
}

/// What the axis words of the block are for (step 5 of spec 12.3).
bool act(Run& run) {
  if (run.block.parts.has_joins && !check_join_words(run)) [[unlikely]]
    return false;
  // each of these refuses what it has no use for
  if (run.action() != GAction::None) run.ledger.take_all();
  switch (run.action()) {
    case GAction::FloatingZero:
    case GAction::LocalZero:
    case GAction::Mirror:
    case GAction::Scaling:
    case GAction::Rotation:
      return true;  // apply_one_shots did it
    case GAction::DrillingCycle:
      return run_aside(run, run_drilling_cycle);
    case GAction::FaceGroove:
    case GAction::DiameterGroove:
      return run_aside(run, run_groove_cycle);
    case GAction::PatternCycle:
      return plan_pattern_cycle(run);
    case GAction::TurningBox:
      return cut_turning_box(run);
    case GAction::FacingBox:
      return cut_facing_box(run);
    case GAction::SingleThread:
      return cut_single_thread(run);
    case GAction::MultipleThread:
      return cut_multiple_thread(run);
    case GAction::MachineCoordinates:
      return move_in_machine(run);
    case GAction::FirstReference:
    case GAction::OtherReference:
      return go_to_reference(run);
    case GAction::ReturnFromReference:
      return return_from_reference(run);
    case GAction::MacroCall:
      if (run.block.parts.macro != 0) return true;
      return passes_arguments(run) ? call_by_g65(run) : suppressed_move(run);
    default:
      return move(run);
  }
}

/// Dwell, zeroes, the move; a probe move ends with its answer.
bool execute_move(Run& run) {
  if (const Answer* answer = run.next_answer()) {
    finish_probe(run, std::get<ProbeResult>(*answer));
    run.item_done();
    return true;
  }
  if (!apply_one_shots(run) || !act(run)) return false;
  return run.ledger.left() == 0 || check_words_used(run);
}

/// A question in a stage resumes there.
void enter(Block::Parts& parts, Stage stage) {
  parts.stage = stage;
  parts.m_next = 0;
}

bool execute_after_move(Run& run) {
  Block::Parts& parts = run.block.parts;
  if (parts.stage == Stage::AfterMove) {
    if (!apply_machine_functions(run, MTiming::AfterMove)) return false;
    enter(parts, Stage::PostMove);
  }
  if (parts.stage == Stage::PostMove) {
    if (!apply_machine_functions(run, MTiming::PostMove)) return false;
    enter(parts, Stage::Flow);
  }
  return plan_flow(run) && apply_machine_functions(run, MTiming::Flow);
}

}  // namespace

bool execute_block(Run& run) {
  Block::Parts& parts = run.block.parts;
  if (parts.stage == Stage::Execution) {
    if (!check_words(run) || !apply_modes(run)) return false;
    enter(parts, Stage::BeforeMove);
  }
  if (parts.stage == Stage::BeforeMove) {
    if (parts.m_count != 0 && !apply_machine_functions(run, MTiming::BeforeMove)) return false;
    parts.stage = Stage::Move;
  }
  if (parts.stage == Stage::Move) {
    if (!execute_move(run)) return false;
    enter(parts, Stage::AfterMove);
  }
  if (parts.m_count == 0 && parts.macro == 0) [[likely]]
    return true;
  return execute_after_move(run);
}

}  // namespace dripline::interpreter::centurion
