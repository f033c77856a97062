#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gateway/interpreter/core/dialect.hpp"
#include "gateway/interpreter/core/interpreter.hpp"
#include "gateway/machine/capability_filter.hpp"
#include "protocol/base/clock.hpp"

namespace dripline::gateway {

/// Looks through a program before its first move for what the machine cannot do: the middle of a
/// cut is the worst place for an alarm. It ends at a question whose answer is not known beforehand,
/// at the program's end, and after kLimit; what it has not reached stays an alarm at its place. One
/// thread.
class ProgramCheck {
 public:
  struct Parts {
    std::unique_ptr<machine::MotionCheck> machine;
    const machine::MotionCapabilities& capabilities;  ///< of the machine, which outlives the check
    const interpreter::Dialect& dialect;
    interpreter::Position at = {};      ///< of the program at its beginning, which
    machine::ToolLengths lengths = {};  ///< leaves these out
    std::vector<std::string> answers;   ///< of the setup, to the program's prompts
  };
  explicit ProgramCheck(Parts parts);
  ProgramCheck(const ProgramCheck&) = delete;
  ProgramCheck& operator=(const ProgramCheck&) = delete;

  /// For an interpreter that is given to `begin` then.
  interpreter::EventSink& events() { return filter_; }
  /// `interpreter`: at the program's beginning.
  void begin(std::unique_ptr<interpreter::Interpreter> interpreter) {
    interpreter_ = std::move(interpreter);
  }

  enum class State { Working, NeedsText, Passed, Refused };
  /// A bounded piece of work.
  State work(SteadyTime now);
  State state() const { return state_; }
  bool is_over() const { return state_ == State::Passed || state_ == State::Refused; }
  /// When refused: what the machine cannot do, with its line.
  const interpreter::Alarm& refusal() const { return refusal_; }
  /// Looked through so far, for the operator.
  std::uint64_t block() const { return interpreter_->blocks(); }

  static constexpr std::chrono::seconds kLimit{10};

 private:
  /// Keeps the first alarm of the filter in front of it.
  class Refusals final : public interpreter::EventFilter {
   public:
    using EventFilter::EventFilter;
    void on_alarm(const interpreter::Alarm& alarm) override;
    std::optional<interpreter::Diagnostic> first;
  };

  bool answer();
  std::optional<interpreter::Diagnostic> found() const;

  Parts parts_;
  std::unique_ptr<interpreter::Interpreter> interpreter_;
  Refusals refusals_;
  machine::CapabilityFilter filter_;
  State state_ = State::Working;
  std::optional<SteadyTime> began_;
  std::size_t next_answer_ = 0;
  interpreter::Alarm refusal_;
};

}  // namespace dripline::gateway
