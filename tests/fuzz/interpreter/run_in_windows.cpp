#include "tests/fuzz/interpreter/run_in_windows.hpp"

#include <algorithm>
#include <cstdio>

#include "tests/support/event_log.hpp"
#include "tests/support/vanished_words.hpp"

namespace dripline::interpreter {
namespace {

constexpr std::uint64_t kMaxBlocks = 2'000;
constexpr std::uint64_t kMaxCheckedBlocks = 100;
/// Some blocks do much: hole cycles with repeats.
constexpr std::size_t kMaxEvents = 50'000;
/// NotYet at each fetch and one more byte a fetch: a few steps for each byte of each block.
constexpr std::uint64_t kMaxIdleSteps = 100'000;

class PiecesSource final : public ProgramSource {
 public:
  PiecesSource(std::string_view text, std::size_t spare) : text_(text), spare_(spare) {}

  TextWindow fetch(ProgramIndex, std::uint64_t offset, std::size_t min_bytes) override {
    is_ready_ = !is_ready_;
    if (!is_ready_) return {};
    if (offset > text_.size()) __builtin_trap();
    const std::string_view rest = text_.substr(offset);
    // A copy of exact size: reading past its end is caught.
    window_ = std::vector<char>(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(std::min(
                                                                 rest.size(), min_bytes + spare_)));
    return {TextWindow::State::Ready,
            {window_.data(), window_.size()},
            window_.size() == rest.size(),
            {}};
  }
  ProgramLookup find(std::string_view) override { return {ProgramLookup::State::NotFound, 0}; }

 private:
  std::string_view text_;
  std::size_t spare_;
  bool is_ready_ = false;
  std::vector<char> window_;
};

Answer answer_to(const Question& question, std::uint64_t blocks) {
  if (const auto* probe = std::get_if<ProbeQuestion>(&question)) {
    return ProbeResult{true, probe->probe.from};
  }
  if (std::holds_alternative<PromptQuestion>(question)) return PromptAnswer{"1.5"};
  if (std::holds_alternative<InputQuestion>(question)) return blocks % 2 == 0;
  if (std::holds_alternative<SignalQuestion>(question))
    return SignalValue{static_cast<double>(blocks), ""};
  return LocalTime{1993, 12, 17, 12, 51, 52};
}

}  // namespace

std::vector<std::string> run_in_windows(const Dialect& dialect, std::string_view text,
                                        std::size_t spare, const Setup& setup) {
  PiecesSource source(text, spare);
  EventLog log;
  auto interpreter = dialect.make(setup, source, log);
  if (!interpreter) __builtin_trap();
  Interpreter& run = **interpreter;
  for (std::uint64_t idle = 0; run.blocks() < kMaxBlocks && log.lines().size() < kMaxEvents;
       ++idle) {
    if (idle > kMaxIdleSteps) __builtin_trap();
    const std::uint64_t before = run.blocks();
    const StepState state = run.step(1);
    if (state == StepState::Ended || state == StepState::Alarmed) break;
    if (state == StepState::NeedsAnswer && !run.answer(answer_to(run.question(), before))) {
      __builtin_trap();
    }
    if (run.blocks() == before) continue;
    idle = 0;
    if (before % 64 == 0 && !run.restore(run.snapshot())) __builtin_trap();
  }
  return log.lines();
}

void expect_no_vanished_word(const Dialect& dialect, std::string_view text, const Setup& setup) {
  const auto found = find_vanished_word(dialect, text, setup, kMaxCheckedBlocks);
  if (!found) return;
  std::fprintf(stderr, "does nothing: %s\n", found->c_str());
  __builtin_trap();
}

}  // namespace dripline::interpreter
