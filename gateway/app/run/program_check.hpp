#pragma once

#include <functional>
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
/// at the program's end, and after kLimit; what it has not reached stays an alarm at its place.
/// A test run is the same without a limit, and finds the program's own alarms too. One thread.
class ProgramCheck {
 public:
  struct Parts {
    std::unique_ptr<machine::MotionCheck> machine;
    const machine::MotionCapabilities& capabilities;  ///< of the machine, which outlives the check
    const interpreter::Dialect& dialect;
    interpreter::Position at = {};      ///< of the program at its beginning, which
    machine::ToolLengths lengths = {};  ///< leaves these out
    std::vector<std::string> answers;   ///< of the setup, to the program's prompts
    bool is_test = false;
    /// What the control's clock shows; empty: it is not known beforehand.
    std::function<interpreter::LocalTime()> time = {};
    /// Of a called program; empty: it is not known.
    std::function<std::string(interpreter::ProgramIndex)> name_of = {};
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
  /// When passed: what the program asked for where this ended before its end; empty: nothing.
  const std::string& unanswered() const { return unanswered_; }
  /// Looked through so far, for the operator.
  std::uint64_t block() const { return interpreter_->blocks(); }
  const interpreter::Origin& origin() const { return interpreter_->origin(); }
  /// The same: "line 3", "line 3 of O9000".
  std::string place() const { return place_of(origin()); }
  std::optional<machine::Seconds> motion_time() const { return parts_.machine->motion_time(); }

  static constexpr std::chrono::seconds kLimit{10};

 private:
  /// Keeps the first alarm of the filter in front of it.
  class Refusals final : public interpreter::EventFilter {
   public:
    Refusals(interpreter::EventSink& out, bool keeps_all)
        : EventFilter(out), keeps_all_(keeps_all) {}
    void on_alarm(const interpreter::Alarm& alarm) override;
    std::optional<interpreter::Alarm> first;

   private:
    const bool keeps_all_;
  };

  bool answer();
  std::optional<interpreter::Answer> answer_to(const interpreter::Question& question);
  bool takes(const interpreter::Probe& probe);
  std::optional<interpreter::Alarm> found() const;
  State refuse(const interpreter::Alarm& alarm);
  std::string place_of(const interpreter::Origin& origin) const;

  Parts parts_;
  std::unique_ptr<interpreter::Interpreter> interpreter_;
  Refusals refusals_;
  machine::CapabilityFilter filter_;
  State state_ = State::Working;
  std::optional<SteadyTime> began_;
  std::size_t next_answer_ = 0;
  interpreter::Origin previous_;  ///< block
  interpreter::Alarm refusal_;
  std::string unanswered_;
};

}  // namespace dripline::gateway
