#pragma once

#include "gateway/interpreter/core/retained_memory.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/ahead_search.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/start_search.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/text_search.hpp"
#include "gateway/interpreter/dialects/tnc155/run.hpp"

namespace dripline::interpreter::tnc155 {

/// A TNC 151/155: text of either form to events, one block at a time.
class TncInterpreter final : public Interpreter, public RetainedMemory {
 public:
  TncInterpreter(ControlOptions options, State state, std::vector<ToolDefinition> tools,
                 ProgramSource& source, EventSink& sink);

  StepState step(std::uint64_t max_blocks) override;
  const Question& question() const override { return run_.question; }
  Result<void> answer(const Answer& answer) override;
  std::uint64_t blocks() const override { return run_.state.blocks; }
  const Origin& origin() const override { return run_.origin; }
  ActiveModes modes() const override;
  std::optional<CoordinateFrame> frame() const override;
  Snapshot snapshot() const override;
  Result<void> restore(const Snapshot& snapshot) override;
  std::vector<MemoryCell> memory_cells() const override;
  bool read_memory(std::vector<double>& values) override;

 private:
  enum class BlockOutcome : std::uint8_t { Finished, NeedsText, More, Paused };

  BlockOutcome check_calls();
  BlockOutcome run_block();
  BlockOutcome read();
  bool check_number();
  BlockOutcome look_ahead();
  bool is_blend_next(std::string_view text);
  BlockOutcome find_definition();
  BlockOutcome meet_end();
  bool is_start() const;
  BlockOutcome find_way_back();
  std::int32_t block_number() const;
  bool execute_parts();
  bool check_moves();
  bool finish_block();
  StepState paused();
  void place_origin(const TextPlace& at);

  std::unique_ptr<StartGate> gate_;  ///< while the start is looked for; before run_, which feeds it
  Run run_;
  TextSearch search_;
  AheadSearch calls_ahead_;
  AheadSearch definitions_ahead_;
  AheadSearch way_back_;
  std::optional<std::int32_t> came_back_;  ///< the block that comes back over the start; -1: none
  std::size_t part_ = 0;                   ///< of the block in hand, to be done next
  bool peeked_blend_ = false;
  BlockParts parts_ahead_;            ///< of the block after the one in hand, where it was read
  bool has_kept_block_ = false;       ///< read, but its successor has not arrived
  bool is_definition_known_ = false;  ///< of the kept block: the search ahead is done
  ReadingState after_kept_block_;
  bool is_asking_ = false;
};

}  // namespace dripline::interpreter::tnc155
