#pragma once

#include "gateway/interpreter/core/live_values.hpp"
#include "gateway/interpreter/core/retained_memory.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/ahead_search.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/coordinate_frame.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/start_search.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/text_search.hpp"
#include "gateway/interpreter/dialects/tnc155/run.hpp"

namespace dripline::interpreter::tnc155 {

/// A TNC 151/155: text of either form to events, one block at a time.
class TncInterpreter final : public BlockInterpreter<TncInterpreter>,
                             public RetainedMemory,
                             public LiveValues {
 public:
  TncInterpreter(ControlOptions options, State state, std::vector<ToolDefinition> tools,
                 ProgramSource& source, EventSink& sink, std::vector<ToolName> tool_names = {});

  bool set_block_skip(std::uint16_t levels) override {
    if (!run_.options.is_itnc) return false;
    run_.reader.set_block_skip((levels & 2u) != 0);
    return true;
  }
  Result<void> begin_next_text() override;
  ActiveModes modes() const override;
  std::optional<CoordinateFrame> frame() const override;
  bool tilts_tool(const Position& at) const override { return is_tool_tilted(run_.options, at); }
  std::string travel_fault(const Position& from, const Position& to) override;
  std::vector<MemoryCell> memory_cells() const override;
  bool read_memory(std::vector<double>& values) override;
  std::vector<std::string> live_names() const override;
  bool read_live(std::vector<double>& values) override;

 private:
  friend BlockInterpreter;

  BlockOutcome run_block();
  void drop_text() {
    if (!run_.is_in_block) run_.reader.drop_window();
  }
  bool is_at_boundary() const { return !run_.is_in_block; }
  Result<void> take_answer(const Answer& answer);
  void after_restore();

  BlockOutcome check_labels();
  bool name_program();
  BlockOutcome check_calls();
  BlockOutcome next_block();
  BlockOutcome read();
  bool check_number();
  BlockOutcome look_ahead();
  bool is_blend_next(std::string_view text);
  BlockOutcome find_definition();
  BlockOutcome meet_end();
  bool is_start() const;
  bool arrive_at_start();
  std::string unmet_start() const;
  BlockOutcome find_way_back();
  std::int32_t block_number() const;
  bool execute_parts();
  bool check_moves();
  bool finish_block();

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
  std::optional<std::uint64_t> q_seen_;  ///< Run::q_changes at the last read_live
};

}  // namespace dripline::interpreter::tnc155

namespace dripline::interpreter {
extern template class BlockInterpreter<tnc155::TncInterpreter>;
}
