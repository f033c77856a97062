#pragma once

#include "gateway/interpreter/core/interpreter.hpp"
#include "gateway/interpreter/core/retained_memory.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/flow.hpp"
#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

namespace dripline::interpreter::rs274ngc {

/// One run of one program; see Interpreter for the contract. A block is every line that is
/// executed, empty ones included; lines that a condition or a call passes over are none.
class Rs274NgcInterpreter final : public Interpreter, public RetainedMemory {
 public:
  Rs274NgcInterpreter(ControlOptions options, std::vector<Tool> tools, State state,
                      const Parameters& parameters, ProgramSource& source, EventSink& sink);

  /// Which free parameters its parameter file lists, rising: these it keeps for good.
  void set_parameter_file(std::vector<int> numbers) { in_file_ = std::move(numbers); }

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
  enum class Outcome : std::uint8_t { Finished, PassedOver, Paused };
  Outcome run_line();
  bool load_line(LineState& outcome);
  Outcome meet_no_line(LineState state);
  bool meet_percent(const char* at, bool& is_end);
  bool execute();
  bool execute_words(const char* at, bool is_skipped);
  bool finish_words();
  Outcome finish_line();
  StepState paused();

  Run run_;
  Flow flow_;
  bool is_asking_ = false;
  std::vector<int> in_file_;     ///< free parameters that the parameter file lists, rising
  Parameters known_parameters_;  ///< when the memory was read last
  std::vector<Tool> known_tools_;
};

}  // namespace dripline::interpreter::rs274ngc
