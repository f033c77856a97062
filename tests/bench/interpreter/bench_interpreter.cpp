#include <benchmark/benchmark.h>
#include <fmt/core.h>
#include <chrono>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"

/// Blocks per second of an interpreter that nothing holds up, and how that compares with merely
/// reading the same bytes in the same run.
namespace dripline::interpreter {
namespace {

constexpr std::uint64_t kStride = 65'536;

/// What a machine would at least do with a move: look at it.
class CountingSink final : public EventSink {
 public:
  void on_line(const Line& event) override {
    ++moves;
    travel += event.to.linear(Axis::Z).mm();
  }
  void on_alarm(const Alarm& event) override { alarm = event.diagnostic.text; }
  std::uint64_t moves = 0;
  double travel = 0;
  std::string alarm;
};

/// `G1X12.3456Z-0.1234` and `X1.2345Z-2.3456` alternating.
std::string straight_blocks() {
  constexpr std::int64_t kBlocks = 1'000'000;
  std::string text = "G98F30\n";
  for (std::int64_t i = 0; i < kBlocks; ++i) {
    const std::int64_t x = 10'000 + (i * 7919) % 90'000;
    const std::int64_t z = (i * 104'729) % 30'000;
    text += fmt::format("{}X{}.{:04}Z-{}.{:04}\n", i % 4 == 0 ? "G1" : "", x / 10'000, x % 10'000,
                        z / 10'000, z % 10'000);
  }
  return text;
}

constexpr int kMacroPasses = 100'000;

/// Parameters, functions, conditions, a loop and output in every few blocks.
std::string macro_text() {
  return "P1=0 P2=16.4856\nPOPEN P0\nG98 F20\nN10\nP3=P2/2*SIN[30+P1/1000] P4=-[P3*P3+.01]\n"
         "IF P3 > P2 THEN P3=P2\nG1 X[P3*2] Z[P4 MOD 5]\nDPRNT [G1 X#3 Z#4[24]]\nP1=P1+1\n"
         "IF P1<100000 GOTO 10\nPCLOS\n";
}

double seconds_of_scan(const std::string& text) {
  const auto start = std::chrono::steady_clock::now();
  std::uint64_t lines = 0;
  for (const char c : text) lines += c == '\n';
  benchmark::DoNotOptimize(lines);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Ran {
  std::uint64_t blocks = 0;
  double seconds = 0;
};

Ran run(const Dialect& dialect, const std::string& text, const Setup& setup) {
  MemorySource source(text);
  CountingSink sink;
  auto interpreter = dialect.make(setup, source, sink);
  const auto start = std::chrono::steady_clock::now();
  while ((*interpreter)->step(kStride) == StepState::Ran) {
  }
  if (!sink.alarm.empty()) fmt::print(stderr, "alarm: {}\n", sink.alarm);
  return {(*interpreter)->blocks(),
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

void measure(benchmark::State& state, std::string_view control, const std::string& text,
             const std::string& executed, const Setup& setup = {}) {
  const Dialect& dialect = **find_dialect(control);
  Ran total;
  double scanned = 0;
  for (auto _ : state) {
    const Ran ran = run(dialect, text, setup);
    total.blocks += ran.blocks;
    total.seconds += ran.seconds;
    state.SetIterationTime(ran.seconds);
    scanned += seconds_of_scan(executed);
  }
  state.counters["blocks_per_second"] = static_cast<double>(total.blocks) / total.seconds;
  state.counters["times_of_memory_scan"] = total.seconds / scanned;
}

void centurion_straight_blocks(benchmark::State& state) {
  static const std::string kText = straight_blocks();
  measure(state, "centurion", kText, kText);
}
BENCHMARK(centurion_straight_blocks)->UseManualTime()->Unit(benchmark::kMillisecond);

/// The scan reads as many bytes as the loop's passes execute.
void centurion_macros(benchmark::State& state) {
  static const std::string kText = macro_text();
  static const std::string kExecuted = [] {
    std::string executed;
    for (int pass = 0; pass < kMacroPasses; ++pass) executed += kText;
    return executed;
  }();
  measure(state, "centurion", kText, kExecuted);
}
BENCHMARK(centurion_macros)->UseManualTime()->Unit(benchmark::kMillisecond);

void fanuc_straight_blocks(benchmark::State& state) {
  static const std::string kText = straight_blocks() + "M30\n";
  measure(state, "fanuc", kText, kText);
}
BENCHMARK(fanuc_straight_blocks)->UseManualTime()->Unit(benchmark::kMillisecond);

/// A shaft with shoulders, cones and fillets, over and over, cut by a tool with a nose.
std::string contour_text() {
  constexpr int kParts = 60'000;
  std::string text = "G98F30\nT0101M6\nG42G1X1.0Z0.1\n";
  for (int i = 0; i < kParts; ++i) {
    text +=
        "Z-1.0\nX1.5Z-1.5\nZ-2.0\nG2X2.0Z-2.25R.25\nG1X2.5\nG3X3.0Z-2.5R.25\nG1Z-3.0\n"
        "X3.5Z-3.25\nX4.0\nZ-3.5\nX5.0\nZ.1\nX1.0\n";
  }
  return text + "G40X6.0Z1.0\n";
}

/// The same number of blocks as straight moves: what the compensated ones are compared with.
void centurion_contour(benchmark::State& state, bool is_compensated) {
  std::string text = contour_text();
  Setup setup;
  ToolRecord& tool = setup.tools.emplace_back();
  tool.number = 1;
  tool.radius = Length::inch(0.03125);
  tool.tip = 3;
  if (!is_compensated) text.erase(text.find("G42"), 3);
  measure(state, "centurion", text, text, setup);
}
BENCHMARK_CAPTURE(centurion_contour, programmed, false)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(centurion_contour, compensated, true)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

/// As the Centurion's, in custom macro B.
std::string custom_macro_text() {
  return "O1\n#1=0\n#2=16.4856\nPOPEN\nF20.\nN10#3=#2/2*SIN[30+#1/1000]\n#4=-[#3*#3+.01]\n"
         "IF[#3GT#2]THEN#3=#2\nG01X[#3*2]Z[#4/5]\nDPRNT[G1*X#3[44]Z#4[24]]\n#1=#1+1\n"
         "IF[#1LT100000]GOTO10\nPCLOS\nM30\n";
}

void fanuc_macros(benchmark::State& state) {
  static const std::string kText = custom_macro_text();
  static const std::string kExecuted = [] {
    std::string executed;
    for (int pass = 0; pass < kMacroPasses; ++pass) executed += kText;
    return executed;
  }();
  measure(state, "fanuc", kText, kExecuted);
}
BENCHMARK(fanuc_macros)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dripline::interpreter

BENCHMARK_MAIN();
