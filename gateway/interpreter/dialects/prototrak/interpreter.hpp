#pragma once

#include "gateway/interpreter/core/interpreter.hpp"
#include "gateway/interpreter/core/language/line_reader.hpp"
#include "gateway/interpreter/dialects/prototrak/executor.hpp"
#include "gateway/interpreter/dialects/prototrak/receiver.hpp"

namespace dripline::interpreter::prototrak {

/// The ProtoTRAK Plus: receives the whole program, converts it to events, then executes these.
/// A block of the `blocks` counter is an event.
class ProtoTrakInterpreter final : public Interpreter {
 public:
  ProtoTrakInterpreter(ControlOptions options, const Position& start, ProgramSource& source,
                       EventSink& sink);

  StepState step(std::uint64_t max_blocks) override;
  const Question& question() const override { return question_; }
  Result<void> answer(const Answer& answer) override;
  std::uint64_t blocks() const override { return executor_.state().blocks; }
  const Origin& origin() const override;
  ActiveModes modes() const override;
  Snapshot snapshot() const override;
  Result<void> restore(const Snapshot& snapshot) override;

 private:
  enum class Phase : std::uint8_t { Receiving, Running, Ended, Alarmed };

  StepState receive();
  StepState run(std::uint64_t max_blocks);
  void deliver_header();
  StepState refuse_program();
  bool can_begin() const;
  StepState refuse_start();
  void announce_start();
  StepState end();

  const ControlOptions options_;
  LineReader reader_;
  EventSink& sink_;
  Receiver receiver_;
  StoredProgram program_;
  Executor executor_;
  // What a snapshot of the start restores.
  const ExecutionState begun_;
  const std::vector<std::byte> begun_path_;
  Phase phase_ = Phase::Receiving;
  Origin received_at_;
  Question question_;  ///< this control asks nothing
};

}  // namespace dripline::interpreter::prototrak
