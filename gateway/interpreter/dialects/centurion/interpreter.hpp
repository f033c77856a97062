#pragma once

#include <memory>

#include "gateway/interpreter/core/retained_memory.hpp"
#include "gateway/interpreter/dialects/centurion/codes/status_window.hpp"
#include "gateway/interpreter/dialects/centurion/reading/text_search.hpp"
#include "gateway/interpreter/dialects/centurion/run.hpp"
#include "gateway/interpreter/dialects/centurion/start/dry_run.hpp"

namespace dripline::interpreter::centurion {

/// The Milltronics Centurion lathe control: text to events, one block at a time.
class CenturionInterpreter final : public Interpreter, public RetainedMemory {
 public:
  CenturionInterpreter(ControlOptions options, ModalState state, Parameters parameters,
                       ProgramSource& source, EventSink& sink);

  StepState step(std::uint64_t max_blocks) override;
  const Question& question() const override { return run_.question; }
  Result<void> answer(const Answer& answer) override;
  std::uint64_t blocks() const override { return run_.state.blocks; }
  const Origin& origin() const override { return run_.origin; }
  ActiveModes modes() const override { return active_modes(run_); }
  Snapshot snapshot() const override;
  Result<void> restore(const Snapshot& snapshot) override;
  std::vector<MemoryCell> memory_cells() const override;
  bool read_memory(std::vector<double>& values) override;

 private:
  enum class BlockOutcome : std::uint8_t { Finished, NoBlock, Paused, More };

  BlockOutcome run_block();
  BlockOutcome meet_line_state(TextCursor::State state);
  bool begin_block();
  bool is_end_of_segment() const;
  bool is_skipped() const;
  void settle_name();
  bool finish_block();
  StepState paused();
  void place_origin();
  bool fits_mode();
  bool starts_here() const;
  bool may_start_here();
  BlockOutcome look_back();
  BlockOutcome find_way_back();
  bool settle_in_search();
  bool begin_at_first();

  // What the run's events pass on their way to the owner's sink; each only where it is asked for.
  std::unique_ptr<DryRun> dry_run_;
  std::unique_ptr<StartSearch> start_;
  std::optional<Snapshot> first_;  ///< the state at the first block, while a start is looked for
  Run run_;
  TextSearch search_;
  bool is_asking_ = false, is_way_back_known_ = false, is_looking_back_ = false;
  Units memory_units_;       ///< of the tables at the start
  Parameters known_memory_;  ///< when it was read last
};

}  // namespace dripline::interpreter::centurion
