#pragma once

#include "gateway/interpreter/core/live_values.hpp"
#include "gateway/interpreter/core/retained_memory.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/text_search.hpp"
#include "gateway/interpreter/dialects/fanuc/run.hpp"

namespace dripline::interpreter::fanuc {

/// A Fanuc-class machining center control: text to events, one block at a time.
class FanucInterpreter final : public BlockInterpreter<FanucInterpreter>,
                               public RetainedMemory,
                               public LiveValues {
 public:
  FanucInterpreter(ControlOptions options, ModalState state, const Memory& memory,
                   ProgramSource& source, EventSink& sink);

  bool set_block_skip(std::uint16_t levels) override {
    run_.skip_levels = levels;
    return true;
  }
  Result<void> begin_next_text() override;
  ActiveModes modes() const override;
  std::optional<CoordinateFrame> frame() const override;
  bool tilts_tool(const Position& machine) const override;
  std::string travel_fault(const Position& from, const Position& to) override;
  std::vector<MemoryCell> memory_cells() const override;
  bool read_memory(std::vector<double>& values) override;
  /// #1 to #33 of the program that is executed, and #100 and up where a reset clears them.
  std::vector<std::string> live_names() const override;
  bool read_live(std::vector<double>& values) override;

 private:
  friend BlockInterpreter;

  BlockOutcome run_block();
  void drop_text() { run_.text.invalidate(); }
  bool is_at_boundary() const { return run_.block.parts.stage == Stage::Start; }
  Result<void> take_answer(const Answer& answer);
  void after_restore();

  BlockOutcome meet_line_state(TextCursor::State state);
  BlockOutcome read();
  bool begin_other_block();
  bool is_plain() const;
  void determine_name();
  bool finish_block();
  bool count_block();

  Run run_;
  TextSearch search_;
  bool is_leader_ = false;
  std::size_t answers_of_reading_ = 0;
  struct KnownMemory {
    decltype(ModalState::commons) commons{};
    decltype(ModalState::kept) kept{};
    decltype(ModalState::extra) extra;
    decltype(ModalState::counters) counters{};
    decltype(Coordinates::work) work{};
    ToolOffsets tools;
  };
  KnownMemory known_memory_;  ///< when it was read last
  struct KnownLive {
    Locals locals{};
    decltype(ModalState::commons) commons{};
  };
  std::optional<KnownLive> known_live_;  ///< likewise
};

}  // namespace dripline::interpreter::fanuc

namespace dripline::interpreter {
extern template class BlockInterpreter<fanuc::FanucInterpreter>;
}
