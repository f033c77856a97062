#pragma once

#include "gateway/interpreter/core/retained_memory.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/text_search.hpp"
#include "gateway/interpreter/dialects/fanuc/run.hpp"

namespace dripline::interpreter::fanuc {

/// A Fanuc-class machining center control: text to events, one block at a time.
class FanucInterpreter final : public Interpreter, public RetainedMemory {
 public:
  FanucInterpreter(ControlOptions options, ModalState state, const Memory& memory,
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
  enum class BlockOutcome : std::uint8_t { Finished, NoBlock, NeedsText, Paused };

  BlockOutcome run_block();
  BlockOutcome meet_line_state(TextCursor::State state);
  BlockOutcome read();
  bool begin_other_block();
  bool is_plain() const;
  void settle_name();
  bool finish_block();
  bool count_block();
  StepState paused();
  void place_origin();

  Run run_;
  TextSearch search_;
  bool is_asking_ = false;
  bool is_leader_ = false;
  std::size_t answers_of_reading_ = 0;
  struct KnownMemory {
    decltype(ModalState::commons) commons{};
    decltype(ModalState::kept) kept{};
    decltype(ModalState::counters) counters{};
    decltype(Coordinates::work) work{};
    ToolOffsets tools;
  };
  KnownMemory known_memory_;  ///< when it was read last
};

}  // namespace dripline::interpreter::fanuc
