#include "gateway/interpreter/dialects/centurion/codes/execution.hpp"

#include "gateway/interpreter/dialects/centurion/codes/machine_functions.hpp"
#include "gateway/interpreter/dialects/centurion/flow/flow.hpp"
#include "gateway/interpreter/dialects/centurion/motion/corner_words.hpp"
#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"

namespace dripline::interpreter::centurion {
namespace {

/// Uses the axis words of the block.
bool act(Run& run) {
  const Block::Parts& parts = run.block.parts;
  if (parts.has_corner_words && !check_corner_words(run)) [[unlikely]]
    return false;
  if (parts.axis_row == kNoRow) [[likely]]
    return move(run);
  run.ledger.take_all();  // each of these refuses the words it does not use
  return g_row(parts.axis_row).act(run);
}

/// The dwell, the move or what takes its place; a probe move ends with its answer.
bool execute_move(Run& run) {
  if (const Answer* answer = run.next_answer()) {
    finish_probe(run, std::get<ProbeResult>(*answer));
    run.item_done();
    return true;
  }
  if (!act_before_move(run) || !act(run)) return false;
  return run.ledger.left() == 0 || check_words_used(run);
}

/// After a question the block resumes in its stage.
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
