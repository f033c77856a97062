#include "clients/tools/offline/offline_run.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace dripline::interpreter {
namespace offline_parts {  // members of OfflineRun::Parts

/// Blocks between two looks at the limit.
constexpr std::uint64_t kStride = 65'536;
constexpr LocalTime kDefaultTime{2000, 1, 1, 0, 0, 0};

/// What a run looks at itself of the events that it hands on.
class Diagnostics final : public EventFilter {
 public:
  using EventFilter::EventFilter;

  void on_block_end(const Origin& origin) override {
    out().on_block_end(origin);
    if (origin.program >= furthest_.size()) furthest_.resize(origin.program + std::size_t{1});
    std::uint64_t& furthest = furthest_[origin.program];
    if (origin.offset >= furthest) [[likely]] {
      furthest = origin.offset + 1;
    } else {
      ++repeated;
    }
  }
  void on_warning(const Warning& event) override {
    out().on_warning(event);
    ++warnings;
  }
  void on_dwell(const Dwell& event) override {
    out().on_dwell(event);
    dwelt += event.seconds;
  }
  void on_alarm(const Alarm& event) override {
    out().on_alarm(event);
    alarm = event.diagnostic;
    program = event.origin.program;
  }

  std::uint64_t warnings = 0;
  std::optional<Diagnostic> alarm;
  ProgramIndex program = kMainProgram;
  std::uint64_t repeated = 0;  ///< blocks that had been executed before
  double dwelt = 0;            ///< seconds

 private:
  std::vector<std::uint64_t> furthest_;  ///< by program: after the block that begins last
};

constexpr std::string_view kEndlessId = "OFF0001";

/// The last event of a program that repeats for ever.
void report_endless(const Interpreter& interpreter, std::uint64_t repeated, EventSink& sink) {
  const Origin& origin = interpreter.origin();
  sink.on_alarm({origin,
                 {kEndlessId,
                  fmt::format("the program repeats without end: stopped after {} blocks that had "
                              "been executed before, the limit of an offline run",
                              repeated),
                  origin.line, 0}});
}

/// Gives the answers of a setup, in order.
class SetupAnswers {
 public:
  SetupAnswers(const Setup& setup, std::vector<std::int64_t> pins, const Diagnostics& diagnostics)
      : setup_(setup), pins_(std::move(pins)), diagnostics_(diagnostics) {}

  Result<Answer> operator()(const ProbeQuestion& question, const Origin&) {
    return Answer(setup_.workpiece.probe(question.probe));
  }
  Result<Answer> operator()(const PromptQuestion& question, const Origin& origin) {
    if (used_ == setup_.answers.size()) {
      return fail(Errc::NotFound,
                  "line {}: the program asks \"{}\" and there is no answer left; the setup's "
                  "`answers` hold {}",
                  origin.line, question.text, setup_.answers.size());
    }
    return Answer(PromptAnswer{setup_.answers[used_++]});
  }
  /// Offline what a program waits for happens: it is not looked at to see its errors alone.
  Result<Answer> operator()(const InputQuestion& question, const Origin&) {
    if (question.wait != InputWait::Nothing) return Answer(true);
    return Answer(std::find(pins_.begin(), pins_.end(), question.pin) != pins_.end());
  }
  Result<Answer> operator()(const SignalQuestion&, const Origin&) {
    return Answer(SignalValue{
        std::nullopt, "offline no machine has it: name it in the setup's [control] hal = { ... }"});
  }
  Result<Answer> operator()(const TimeQuestion&, const Origin& origin) {
    // A program that waits for its clock would wait for ever in a run that takes no time: dwells
    // count, and a block that asks again takes a second.
    const auto dwelt =
        static_cast<std::int64_t>(std::min(std::round(diagnostics_.dwelt * 1000), 1e12));
    const bool is_new = asked_at_.insert({origin.program, origin.offset}).second;
    if (!is_new && origin.block != asked_in_) ++waited_;
    asked_in_ = origin.block;
    const LocalTime begun = setup_.date_time.value_or(kDefaultTime);
    return Answer(local_time_at(milliseconds_of(begun) + dwelt + 1000 * waited_));
  }

 private:
  const Setup& setup_;
  std::vector<std::int64_t> pins_;
  const Diagnostics& diagnostics_;
  std::size_t used_ = 0;
  std::set<std::pair<ProgramIndex, std::uint64_t>> asked_at_;  ///< blocks
  std::uint64_t asked_in_ = 0;
  std::int64_t waited_ = 0;  ///< seconds
};

Result<void> answer_question(Interpreter& interpreter, SetupAnswers& answers) {
  const Origin origin = interpreter.origin();
  const auto answer = std::visit([&](const auto& question) { return answers(question, origin); },
                                 interpreter.question());
  if (!answer) return fail(answer.error());
  return interpreter.answer(*answer);
}

}  // namespace offline_parts

struct OfflineRun::Parts {
  Parts(const Setup& setup, std::vector<std::int64_t> pins, EventSink& sink, OfflineLimits bounds)
      : limits(bounds),
        diagnostics(sink),
        gate(diagnostics, bounds.stop.value_or(StopPoint{})),
        answers(setup, std::move(pins), diagnostics) {}

  Result<bool> step(std::uint64_t max_blocks);

  OfflineLimits limits;
  offline_parts::Diagnostics diagnostics;
  StopGate gate;
  offline_parts::SetupAnswers answers;
  std::unique_ptr<Interpreter> interpreter;
  std::vector<AskedQuestion> asked;
  bool has_ended = false;
};

Result<bool> OfflineRun::Parts::step(std::uint64_t max_blocks) {
  if (interpreter->blocks() >= limits.max_blocks) {
    return fail(Errc::LimitExceeded,
                "line {}: stopped after {} blocks, the limit of an offline run",
                interpreter->origin().line, limits.max_blocks);
  }
  const std::uint64_t left = limits.max_blocks - interpreter->blocks();
  const StepState state = interpreter->step(std::min({left, max_blocks, limits.stop ? 1 : left}));
  has_ended = state == StepState::Ended;
  if (has_ended && limits.reads_on && !gate.has_stopped() && interpreter->read_on()) return false;
  if (gate.has_stopped() || has_ended || state == StepState::Alarmed) return true;
  if (diagnostics.repeated > limits.max_repeated_blocks) {
    offline_parts::report_endless(*interpreter, diagnostics.repeated, diagnostics);
    return true;
  }
  if (state == StepState::NeedsText) {
    return fail(Errc::Io, "line {}: the text of the program is not all there",
                interpreter->origin().line);
  }
  if (state == StepState::NeedsAnswer) {
    const std::size_t kind = interpreter->question().index();
    if (std::ranges::find(asked, kind, &AskedQuestion::kind) == asked.end())
      asked.push_back({kind, interpreter->origin()});
    if (auto answered = offline_parts::answer_question(*interpreter, answers); !answered) {
      return fail(answered.error());
    }
  }
  return false;
}

OfflineRun::OfflineRun(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
OfflineRun::OfflineRun(OfflineRun&&) noexcept = default;
OfflineRun& OfflineRun::operator=(OfflineRun&&) noexcept = default;
OfflineRun::~OfflineRun() = default;

Result<OfflineRun> OfflineRun::begin(const Dialect& dialect, const Setup& setup,
                                     ProgramSource& source, EventSink& sink, OfflineLimits limits) {
  auto pins = setup.control.integers("pins");
  if (!pins) return fail(pins.error());
  auto parts = std::make_unique<Parts>(setup, *std::move(pins), sink, limits);
  EventSink& first = limits.stop ? static_cast<EventSink&>(parts->gate) : parts->diagnostics;
  auto interpreter = dialect.make(setup, source, first);
  if (!interpreter) return fail(interpreter.error());
  parts->interpreter = *std::move(interpreter);
  return OfflineRun(std::move(parts));
}

Result<bool> OfflineRun::step(std::uint64_t max_blocks) {
  return parts_->step(max_blocks);
}

Interpreter& OfflineRun::interpreter() {
  return *parts_->interpreter;
}

OfflineOutcome OfflineRun::outcome() const {
  return {.ended = parts_->has_ended,
          .has_stopped = parts_->gate.has_stopped(),
          .blocks = parts_->interpreter->blocks(),
          .warnings = parts_->diagnostics.warnings,
          .alarm = parts_->diagnostics.alarm,
          .alarm_program = parts_->diagnostics.program,
          .asked = parts_->asked};
}

Result<OfflineOutcome> run_offline(const Dialect& dialect, const Setup& setup,
                                   ProgramSource& source, EventSink& sink, OfflineLimits limits) {
  auto run = OfflineRun::begin(dialect, setup, source, sink, limits);
  if (!run) return fail(run.error());
  for (;;) {
    const auto is_over = run->step(offline_parts::kStride);
    if (!is_over) return fail(is_over.error());
    if (*is_over) return run->outcome();
  }
}

}  // namespace dripline::interpreter
