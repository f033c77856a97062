#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "gateway/interpreter/registry.hpp"
#include "gateway/interpreter/stages/event_filter.hpp"

namespace dripline::interpreter {

/// Where an offline run may end early: after the first block of the started program that has this
/// number, or that begins in this line.
struct StopPoint {
  std::optional<std::int64_t> sequence;
  std::optional<std::uint64_t> line;

  bool is_at(const Origin& origin) const {
    if (origin.program != kMainProgram) return false;
    return sequence ? origin.sequence == *sequence : line && origin.line == *line;
  }
};

/// Delivers events to a sink up to the end of the block at a stop point, and nothing after it: an
/// interpreter that looks ahead is then further on. The sink must outlive it.
class StopGate final : public EventGate {
 public:
  StopGate(EventSink& sink, StopPoint stop) : EventGate(sink), stop_(stop) {}

  bool has_stopped() const { return has_stopped_; }

  void on_block_end(const Origin& event) override {
    EventGate::on_block_end(event);
    has_stopped_ |= stop_.is_at(event);
  }

 private:
  bool is_open() const override { return !has_stopped_; }

  StopPoint stop_;
  bool has_stopped_ = false;
};

struct OfflineLimits {
  std::uint64_t max_blocks =
      1'000'000'000;  ///< executed; an endless program is stopped with an alarm
  /// Executed that had been executed before: a loop without end is legitimate at a machine, and
  /// ends here with the alarm OFF0001.
  std::uint64_t max_repeated_blocks = 10'000'000;
  std::optional<StopPoint> stop = {};  ///< the run ends after that block
  /// A tape is read on after the end of a program, as by another cycle start: events of the next
  /// one follow that end.
  bool reads_on = false;
};

/// A kind of question that a run was asked, as the index of its alternative of `Question`.
struct AskedQuestion {
  std::size_t kind = 0;
  Origin origin;  ///< of the first one
};

struct OfflineOutcome {
  bool ended = false;  ///< the end of the program was reached; otherwise `alarm` has the reason
  bool has_stopped = false;  ///< or the run met the limits' stop point
  std::uint64_t blocks = 0;
  std::uint64_t warnings = 0;
  std::optional<Diagnostic> alarm;
  ProgramIndex alarm_program = kMainProgram;  ///< whose line the alarm names
  std::vector<AskedQuestion> asked = {};      ///< each kind once, in their order
};

/// Runs a program to its end as fast as it goes, and answers its questions from the setup: probes
/// from `workpiece`, prompts from `answers` in order, input pins from the option `pins` (those that
/// read 1), the clock from `date_time` (2000-01-01T00:00:00 when there is none). `source` must hold
/// all of its text (MemorySource).
/// Errors, after which the sink has had every event up to there: what `Dialect::make` says about
/// the setup; NotFound: a prompt, and no answer is left; LimitExceeded: `limits`; Io: text is
/// missing.
Result<OfflineOutcome> run_offline(const Dialect& dialect, const Setup& setup,
                                   ProgramSource& source, EventSink& sink,
                                   OfflineLimits limits = {});

/// The same in pieces, for a caller that does something else between them. What it was begun with
/// must outlive it.
class OfflineRun {
 public:
  static Result<OfflineRun> begin(const Dialect& dialect, const Setup& setup, ProgramSource& source,
                                  EventSink& sink, OfflineLimits limits = {});
  OfflineRun(OfflineRun&&) noexcept;
  OfflineRun& operator=(OfflineRun&&) noexcept;
  ~OfflineRun();

  /// Executes up to `max_blocks`. True: the run is over. Errors: as run_offline; it is over then.
  Result<bool> step(std::uint64_t max_blocks);
  OfflineOutcome outcome() const;
  /// Of this run; between two calls of `step`, and within one for what an event needs.
  Interpreter& interpreter();

 private:
  struct Parts;
  explicit OfflineRun(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
};

/// Delivers every event to two sinks, one after the other. Both must outlive it.
class EventTee final : public EventRelay<EventTee> {
 public:
  EventTee(EventSink& first, EventSink& second) : first_(first), second_(second) {}

 private:
  friend EventRelay;
  template <class Event>
  void pass(void (EventSink::*deliver)(const Event&), const Event& event) {
    (first_.*deliver)(event);
    (second_.*deliver)(event);
  }

  EventSink& first_;
  EventSink& second_;
};

}  // namespace dripline::interpreter
