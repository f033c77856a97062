#include <gtest/gtest.h>
#include <algorithm>
#include <cstdlib>

#include "clients/tools/offline/offline_run.hpp"
#include "clients/tools/offline/trace_writer.hpp"
#include "tests/golden/golden_case.hpp"
#include "tests/support/event_log.hpp"
#include "tests/support/vanished_words.hpp"

/// Every golden program of every dialect: its trace, and that neither the windows its text comes
/// in nor a restart at any block boundary can be seen in what it does.
namespace dripline::interpreter {
namespace {

class Golden : public testing::TestWithParam<GoldenName> {
 protected:
  void SetUp() override {
    golden_ = read_golden_case(GetParam().control, GetParam().name);
    const auto found = find_dialect(golden_.control);
    ASSERT_TRUE(found) << found.error().what;
    dialect_ = *found;
    setup_ = setup_of(golden_, *dialect_);
    program_ = golden_.program();
  }

  void expect_trace();
  void expect_no_vanished_word();
  void expect_last_block_ended();
  void expect_same_in_windows();
  void expect_same_from_block_boundaries();

  GoldenCase golden_;
  const Dialect* dialect_ = nullptr;
  interpreter::Setup setup_;  // qualified: gtest keeps a private member of that name
  std::string program_;
};

bool accepts() {
  const char* accept = std::getenv("DRIPLINE_ACCEPT");
  return accept != nullptr && std::string_view(accept) == "1";
}

void Golden::expect_trace() {
  MemorySource source(program_, loader_of(golden_));
  std::string trace;
  std::optional<OfflineOutcome> outcome;
  {
    TraceWriter writer([&](std::string_view lines) { trace += lines; }, setup_.start);
    const auto ran = run_offline(*dialect_, setup_, source, writer);
    ASSERT_TRUE(ran) << ran.error().what;
    outcome = *ran;
  }
  const auto verdict = verdict_of(golden_);
  ASSERT_EQ(verdict.has_value(), outcome->alarm.has_value())
      << (outcome->alarm ? outcome->alarm->text : "no alarm");
  if (verdict) {
    EXPECT_EQ(outcome->alarm->id, verdict->id) << outcome->alarm->text;
    EXPECT_EQ(outcome->alarm->line, verdict->line) << outcome->alarm->text;
    EXPECT_EQ(outcome->alarm->column, verdict->column) << outcome->alarm->text;
  }
  if (accepts()) {
    accept_trace(golden_, trace);
    return;
  }
  EXPECT_EQ(trace, golden_.text("expected.jsonl"));
}

/// Gives every text in windows of at most `chunk` bytes more than asked for, each only after one
/// NotYet.
class SlowSource final : public ProgramSource {
 public:
  SlowSource(ProgramSource& whole, std::size_t chunk) : whole_(whole), chunk_(chunk) {}

  TextWindow fetch(ProgramIndex program, std::uint64_t offset, std::size_t min_bytes) override {
    if (!std::exchange(is_ready_, !is_ready_)) return {};
    TextWindow window = whole_.fetch(program, offset, min_bytes);
    const std::size_t size = std::min(window.text.size(), min_bytes + chunk_);
    window.reaches_end = window.reaches_end && size == window.text.size();
    text_.assign(window.text.substr(0, size));  // moves at every call, as a window may
    window.text = text_;
    return window;
  }
  ProgramLookup find(std::string_view name) override {
    if (!std::exchange(is_ready_, !is_ready_)) return {};
    return whole_.find(name);
  }

 private:
  ProgramSource& whole_;
  std::size_t chunk_;
  bool is_ready_ = false;
  std::string text_;
};

void Golden::expect_no_vanished_word() {
  constexpr std::uint64_t kMaxBlocks = 300;
  const auto found =
      find_vanished_word(*dialect_, program_, setup_, kMaxBlocks, loader_of(golden_));
  EXPECT_FALSE(found) << *found;
}

struct Boundary {
  Snapshot snapshot;
  std::size_t events = 0;   ///< logged before it
  std::size_t answers = 0;  ///< prompts answered before it
  std::uint64_t blocks = 0;
};

/// Steps one block at a time to the end. `on_boundary` sees every block boundary.
class Stepper {
 public:
  Stepper(Interpreter& interpreter, const Setup& setup, std::size_t answers_used = 0)
      : interpreter_(interpreter), setup_(setup), answers_used_(answers_used) {}

  template <class OnBoundary>
  void run(OnBoundary on_boundary) {
    constexpr std::uint64_t kMaxSteps = 1'000'000;
    for (std::uint64_t steps = 0; steps < kMaxSteps; ++steps) {
      switch (interpreter_.step(1)) {
        case StepState::Ended:
        case StepState::Alarmed:
          return;
        case StepState::Ran:
          on_boundary(answers_used_);
          break;
        case StepState::NeedsText:
          break;
        case StepState::NeedsAnswer:
          answer();
          break;
      }
    }
    FAIL() << "the program does not end";
  }

 private:
  void answer() {
    const auto& question = interpreter_.question();
    Answer answer;
    if (const auto* probe = std::get_if<ProbeQuestion>(&question)) {
      answer = setup_.workpiece.probe(probe->probe.from, probe->probe.to, probe->probe.until);
    } else if (std::holds_alternative<PromptQuestion>(question)) {
      answer = PromptAnswer{setup_.answers.at(answers_used_++)};
    } else if (std::holds_alternative<InputQuestion>(question)) {
      answer = false;
    } else if (std::holds_alternative<SignalQuestion>(question)) {
      answer =
          SignalValue{std::nullopt,
                      "offline no machine has it: name it in the setup's [control] hal = { ... }"};
    } else {
      answer = setup_.date_time.value_or(LocalTime{2000, 1, 1, 0, 0, 0});
    }
    ASSERT_TRUE(interpreter_.answer(answer));
  }

  Interpreter& interpreter_;
  const Setup& setup_;
  std::size_t answers_used_;
};

/// The machine reports the block that ends the program as executed, too.
void Golden::expect_last_block_ended() {
  MemorySource whole(program_, loader_of(golden_));
  EventLog log;
  auto interpreter = dialect_->make(setup_, whole, log);
  ASSERT_TRUE(interpreter) << interpreter.error().what;
  Stepper(**interpreter, setup_).run([](std::size_t) {});
  if (!log.lines().empty() && log.lines().back().starts_with("alarm ")) return;
  const auto last = std::find_if(log.lines().rbegin(), log.lines().rend(),
                                 [](const auto& line) { return line.starts_with("block "); });
  ASSERT_NE(last, log.lines().rend());
  EXPECT_TRUE(last->starts_with("block " + std::to_string((*interpreter)->blocks()) + ":"))
      << *last;
}

void Golden::expect_same_in_windows() {
  MemorySource whole(program_, loader_of(golden_));
  EventLog expected;
  auto reference = dialect_->make(setup_, whole, expected);
  ASSERT_TRUE(reference) << reference.error().what;
  Stepper(**reference, setup_).run([](std::size_t) {});
  for (const std::size_t chunk : {0, 1, 7, 64}) {
    SlowSource source(whole, chunk);
    EventLog log;
    auto interpreter = dialect_->make(setup_, source, log);
    Stepper(**interpreter, setup_).run([](std::size_t) {});
    ASSERT_EQ(log.lines(), expected.lines()) << "with windows of " << chunk << " bytes to spare";
  }
}

/// A restart compares the digests (gateway/app/restart). What a stage leaves of a move shows within
/// the next ones.
void expect_state(const Interpreter& interpreter, const std::vector<Boundary>& boundaries,
                  std::size_t from, std::size_t at) {
  constexpr std::size_t kBoundaries = 8;
  if (at >= boundaries.size() || at > from + kBoundaries) return;
  // A search for a label may have taken a step of its own.
  if (boundaries[at].blocks != interpreter.blocks()) return;
  EXPECT_EQ(interpreter.snapshot().digest(), boundaries[at].snapshot.digest())
      << "after block " << at + 1 << ", resumed after block " << from + 1;
}

void Golden::expect_same_from_block_boundaries() {
  constexpr std::size_t kMaxBoundaries = 150;  // of long programs a sample
  MemorySource source(program_, loader_of(golden_));
  EventLog whole;
  std::vector<Boundary> boundaries;
  auto interpreter = dialect_->make(setup_, source, whole);
  ASSERT_TRUE(interpreter) << interpreter.error().what;
  Stepper(**interpreter, setup_).run([&](std::size_t answers) {
    boundaries.push_back(
        {(*interpreter)->snapshot(), whole.lines().size(), answers, (*interpreter)->blocks()});
  });
  const std::size_t stride = boundaries.size() / kMaxBoundaries + 1;
  for (std::size_t i = 0; i < boundaries.size(); i += stride) {
    EventLog rest;
    auto resumed = dialect_->make(setup_, source, rest);
    ASSERT_TRUE((*resumed)->restore(boundaries[i].snapshot));
    EXPECT_EQ((*resumed)->snapshot().digest(), boundaries[i].snapshot.digest());
    if (HasFailure()) return;
    auto next = i + 1;
    Stepper(**resumed, setup_, boundaries[i].answers).run([&](std::size_t) {
      expect_state(**resumed, boundaries, i, next++);
    });
    const std::vector<std::string> expected(
        whole.lines().begin() + static_cast<std::ptrdiff_t>(boundaries[i].events),
        whole.lines().end());
    ASSERT_EQ(rest.lines(), expected) << "resumed after block " << i + 1;
    if (i > 0) continue;
    // One that has run to the end keeps nothing of that.
    ASSERT_TRUE((*resumed)->restore(boundaries[i].snapshot));
    next = i + 1;
    Stepper(**resumed, setup_, boundaries[i].answers).run([&](std::size_t) {
      expect_state(**resumed, boundaries, i, next++);
    });
  }
}

/// One test for a case: ctest starts a process for each, which takes longer than what it does.
TEST_P(Golden, IsAsExpectedInWindowsAndFromEveryBlock) {
  expect_trace();
  if (accepts()) GTEST_SKIP() << "accepted: review the diff of " << golden_.file;
  expect_no_vanished_word();
  expect_last_block_ended();
  expect_same_in_windows();
  expect_same_from_block_boundaries();
}

/// To register all of them took each 80 ms: where the filter names one case, only this is
/// registered.
std::vector<GoldenName> wanted_names() {
  const std::string filter = GTEST_FLAG_GET(filter);
  const std::size_t slash = filter.find('/');
  const bool is_one =
      slash != std::string::npos && filter.find_first_of("*?:-") == std::string::npos;
  return is_one ? golden_named(filter.substr(slash + 1)) : golden_names();
}

INSTANTIATE_TEST_SUITE_P(, Golden, testing::ValuesIn(wanted_names()),
                         [](const auto& test) { return test_name(test.param); });
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Golden);

}  // namespace
}  // namespace dripline::interpreter
