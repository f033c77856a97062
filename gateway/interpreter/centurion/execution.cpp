#include "gateway/interpreter/centurion/execution.hpp"

#include "gateway/interpreter/centurion/box_cycles.hpp"
#include "gateway/interpreter/centurion/drilling_cycles.hpp"
#include "gateway/interpreter/centurion/flow.hpp"
#include "gateway/interpreter/centurion/g_functions.hpp"
#include "gateway/interpreter/centurion/groove_cycles.hpp"
#include "gateway/interpreter/centurion/machine_functions.hpp"
#include "gateway/interpreter/centurion/motion.hpp"
#include "gateway/interpreter/centurion/reference_points.hpp"
#include "gateway/interpreter/centurion/threads.hpp"

namespace dripline::interpreter::centurion {
namespace {

/// G65 without P: the program and compensation go on, the machine stays.
bool move_in_thought(Run& run) {
  stand_still(run, true);
  const bool is_done = move(run);
  stand_still(run, false);
  return is_done;
}

/// What the axis words of the block are for (step 5 of spec 12.3).
bool act(Run& run) {
  switch (run.action()) {
    case GAction::FloatingZero:
    case GAction::LocalZero:
    case GAction::Mirror:
    case GAction::Scaling:
    case GAction::Rotation:
      return true;  // apply_one_shots did it
    case GAction::DrillingCycle:
      return run_drilling_cycle(run);
    case GAction::FaceGroove:
    case GAction::DiameterGroove:
      return run_groove_cycle(run);
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
    case GAction::NonMovement:
      return move_in_thought(run);
    default:
      return move(run);
  }
}

/// Up to and including the move.
bool execute_move(Run& run) {
  if (const Answer* answer = run.next_answer()) {
    finish_probe(run, std::get<ProbeResult>(*answer));
    run.item_done();
    return true;
  }
  if (!check_words(run) || !apply_modes(run)) return false;
  if (!apply_machine_functions(run, MTiming::BeforeMove)) return false;
  if (!apply_one_shots(run)) return false;
  return act(run);
}

}  // namespace

bool execute_block(Run& run) {
  Block::Parts& parts = run.block.parts;
  if (parts.stage == Stage::Execution) {
    if (!execute_move(run)) return false;
    parts.stage = Stage::AfterMove;
  }
  if (parts.m_count == 0) [[likely]]
    return true;
  return apply_machine_functions(run, MTiming::AfterMove) && plan_flow_of_m_codes(run) &&
         apply_machine_functions(run, MTiming::Flow);
}

}  // namespace dripline::interpreter::centurion
