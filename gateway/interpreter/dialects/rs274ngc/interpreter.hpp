#pragma once

#include "gateway/interpreter/core/interpreter.hpp"
#include "gateway/interpreter/core/live_values.hpp"
#include "gateway/interpreter/core/retained_memory.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/flow.hpp"
#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

namespace dripline::interpreter::rs274ngc {

/// One run of one program; see Interpreter for the contract. A block is every line that is
/// executed, empty ones included; lines that a condition or a call passes over are none.
class Rs274NgcInterpreter final : public BlockInterpreter<Rs274NgcInterpreter>,
                                  public RetainedMemory,
                                  public LiveValues {
 public:
  Rs274NgcInterpreter(ControlOptions options, std::vector<Tool> tools, State state,
                      const Parameters& parameters, ProgramSource& source, EventSink& sink);

  /// Which free parameters its parameter file lists, rising: these it keeps for good.
  void set_parameter_file(std::vector<int> numbers) { in_file_ = std::move(numbers); }

  const State& state() const { return run_.state; }
  /// As before the first block, but for what `state` has.
  void begin_with(State state) {
    run_.state = std::move(state);
    run_.origin = {};
  }

  bool set_block_skip(std::uint16_t levels) override {
    run_.block_skip = (levels & 2u) != 0;
    return true;
  }
  Result<void> begin_next_text() override;
  ActiveModes modes() const override;
  std::optional<CoordinateFrame> frame() const override;
  std::vector<MemoryCell> memory_cells() const override;
  bool read_memory(std::vector<double>& values) override;
  /// Named parameters: the global ones, and those of the call that is executed.
  std::vector<std::string> live_names() const override;
  bool read_live(std::vector<double>& values) override;

 private:
  friend BlockInterpreter;

  BlockOutcome run_block();
  void drop_text() {
    run_.reader.drop_window();
    passed_over_ = 0;
  }
  bool is_at_boundary() const { return run_.block.stage == Stage::Start; }
  Result<void> take_answer(const Answer& answer);
  /// A move whose end was never found is not made.
  void before_alarm();
  void after_restore();

  BlockOutcome run_line();
  bool load_line(LineState& outcome);
  BlockOutcome meet_no_line(LineState state);
  BlockOutcome end_of_mdi();
  bool meet_percent(const char* at, bool& is_end);
  bool execute();
  bool execute_oword(const char* at);
  bool execute_words(const char* at, bool is_skipped);
  bool finish_words();
  BlockOutcome finish_line();

  Run run_;
  Flow flow_;
  std::uint64_t passed_over_ = 0;  ///< lines in this step
  std::vector<int> in_file_;       ///< free parameters that the parameter file lists, rising
  Parameters known_parameters_;    ///< when the memory was read last
  std::vector<Tool> known_tools_;
  struct SeenNames {
    std::uint64_t changes = 0;
    std::size_t level = 0, count = 0;
    friend bool operator==(const SeenNames&, const SeenNames&) = default;
  };
  std::optional<SeenNames> names_seen_;  ///< when they were read last
};

}  // namespace dripline::interpreter::rs274ngc

namespace dripline::interpreter {
extern template class BlockInterpreter<rs274ngc::Rs274NgcInterpreter>;
}
