#pragma once

#include <memory>

#include "gateway/interpreter/core/retained_memory.hpp"
#include "gateway/interpreter/dialects/centurion/reading/text_search.hpp"
#include "gateway/interpreter/dialects/centurion/run.hpp"
#include "gateway/interpreter/dialects/centurion/start/start_search.hpp"

namespace dripline::interpreter::centurion {

/// The Milltronics Centurion lathe control: text to events, one block at a time.
class CenturionInterpreter final : public BlockInterpreter<CenturionInterpreter>,
                                   public RetainedMemory {
 public:
  CenturionInterpreter(ControlOptions options, ModalState state, Parameters parameters,
                       ProgramSource& source, EventSink& sink);

  bool set_block_skip(std::uint16_t levels) override {
    block_skip_ = (levels & 2u) != 0;
    return true;
  }
  Result<void> begin_next_text() override;
  ActiveModes modes() const override;
  std::string travel_fault(const Position& from, const Position& to) override {
    return run_.travel_fault(from, to);
  }
  std::vector<MemoryCell> memory_cells() const override;
  bool read_memory(std::vector<double>& values) override;

 private:
  friend BlockInterpreter;

  BlockOutcome run_block();
  void drop_text() { run_.text.invalidate(); }
  bool is_at_boundary() const { return run_.block.parts.stage == Stage::Start; }
  Result<void> take_answer(const Answer& answer);
  void after_restore();

  BlockOutcome next_block();
  BlockOutcome meet_line_state(TextCursor::State state);
  bool begin_block();
  bool is_end_of_segment() const;
  bool is_skipped() const;
  void determine_name();
  bool finish_block();
  bool fits_mode();
  bool starts_here() const;
  bool may_start_here();
  BlockOutcome look_back();
  BlockOutcome outcome_of_search(TextSearch::Outcome outcome);
  BlockOutcome find_place();
  BlockOutcome find_way_back();
  bool begin_at_first();

  // The run's events pass these before the owner's sink; each exists only where it is asked for.
  std::unique_ptr<DryRun> dry_run_;
  std::unique_ptr<StartSearch> start_;
  std::optional<Snapshot> first_;  ///< the state at the first block, while a start is looked for
  Run run_;
  TextSearch search_;
  bool is_way_back_known_ = false, is_looking_back_ = false;
  bool block_skip_;          ///< the panel's switch
  Units memory_units_;       ///< of the tables at the start
  Parameters known_memory_;  ///< when it was read last
};

}  // namespace dripline::interpreter::centurion

namespace dripline::interpreter {
extern template class BlockInterpreter<centurion::CenturionInterpreter>;
}
