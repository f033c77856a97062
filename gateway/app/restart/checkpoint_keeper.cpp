#include "gateway/app/restart/checkpoint_keeper.hpp"

#include <utility>

#include "protocol/process/log.hpp"

namespace dripline::gateway {

void CheckpointKeeper::take(const State& state) {
  Checkpoint checkpoint;
  checkpoint.block = state.interpreter.blocks();
  checkpoint.executed = state.executed;
  checkpoint.time_us = clock_.now().time_since_epoch().count();
  checkpoint.snapshot = state.interpreter.snapshot();
  checkpoint.delivered = state.delivered;
  checkpoint.machine = state.machine;
  checkpoint.answers = answers_.all;
  checkpoint.prompts = answers_.prompts;
  checkpoint.programs = state.feed.called_programs();
  const bool has_new_programs = checkpoint.programs.size() > programs_;
  programs_ = checkpoint.programs.size();
  report::StoredCheckpoint stored{checkpoint.block, checkpoint.executed.executed, clock_.now(), {}};
  last_block_ = checkpoint.block;
  stored.bytes = encode(run_, std::move(checkpoint));
  if (stored.bytes.size() > kMaxBytes) {
    process::log_warning("run={} checkpoint at block {} left out: {} bytes, the limit is {}", run_,
                         stored.block, stored.bytes.size(), kMaxBytes);
    return;
  }
  outbox_.checkpoints().stage(run_, std::move(stored), has_new_programs);
}

void CheckpointKeeper::note_answer(const interpreter::Answer& answer) {
  if (std::holds_alternative<interpreter::PromptAnswer>(answer)) ++answers_.prompts;
  ++answers_.all;
  outbox_.checkpoints().stage_answer(run_, answers_.all, encode(run_, answers_.all, answer));
}

}  // namespace dripline::gateway
