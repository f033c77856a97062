#pragma once

#include "gateway/interpreter/core/interpreter.hpp"
#include "gateway/interpreter/core/language/line_reader.hpp"
#include "gateway/interpreter/dialects/tektronix1704/run.hpp"

namespace dripline::interpreter::tektronix1704 {

/// The Tektronix 1704 contouring control: a tape's characters to events, one block at a time.
class TektronixInterpreter final : public Interpreter {
 public:
  TektronixInterpreter(ControlOptions options, ProgramSource& source, EventSink& sink);

  StepState step(std::uint64_t max_blocks) override;
  const Question& question() const override { return question_; }
  Result<void> answer(const Answer& answer) override;
  std::uint64_t blocks() const override { return run_.state.blocks; }
  const Origin& origin() const override { return run_.state.at; }
  ActiveModes modes() const override;
  Snapshot snapshot() const override;
  Result<void> restore(const Snapshot& snapshot) override;

 private:
  enum class Outcome : std::uint8_t { Finished, NoBlock, NeedsText, Ended, Alarmed };

  Outcome run_line();
  Outcome run_mdi_block();
  Outcome meet(LineState state);
  Outcome hunt(std::string_view line);
  Outcome search();
  Outcome execute();
  Outcome end_of_tape();
  Outcome alarm();
  void begin_block(const TextPlace& place);
  void close_block();

  Run run_;
  LineReader reader_;
  Question question_;  ///< this control asks nothing
};

}  // namespace dripline::interpreter::tektronix1704
