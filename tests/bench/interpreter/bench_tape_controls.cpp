#include <benchmark/benchmark.h>
#include <fmt/core.h>
#include <chrono>
#include <string>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"

/// Straight blocks of the Tektronix 1704 and cutting events of the ProtoTRAK Plus, in proportion to
/// straight RS274/NGC blocks in the same run: at least half of their rate.
namespace dripline::interpreter {
namespace {

class MoveSink final : public EventSink {
 public:
  void on_line(const Line& event) override { travel += event.to.linear(Axis::X).mm(); }
  void on_warning(const Warning& event) override { fault = event.diagnostic.text; }
  void on_alarm(const Alarm& event) override { fault = event.diagnostic.text; }
  double travel = 0;
  std::string fault;
};

/// Blocks per second.
double rate_of(std::string_view control, const std::string& text) {
  MemorySource source(text);
  MoveSink sink;
  auto interpreter = (*find_dialect(control))->make(Setup{}, source, sink);
  const auto start = std::chrono::steady_clock::now();
  while ((*interpreter)->step(65'536) == StepState::Ran) {
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  benchmark::DoNotOptimize(sink.travel);
  if (!sink.fault.empty()) fmt::print(stderr, "{}: {}\n", control, sink.fault);
  return static_cast<double>((*interpreter)->blocks()) / elapsed.count();
}

constexpr std::int64_t kBlocks = 1'000'000;

std::int64_t x_of(std::int64_t i) {
  return 10'000 + (i * 7919) % 90'000;
}
std::int64_t y_of(std::int64_t i) {
  return (i * 104'729) % 30'000;
}

const std::string& ngc_text() {
  static const std::string kText = [] {
    std::string text = "G21 G17 G90\nG94 F1000\n";
    for (std::int64_t i = 0; i < kBlocks; ++i) {
      text += fmt::format("{}X{}.{:03} Y-{}.{:03}\n", i % 4 == 0 ? "G1 " : "", x_of(i) / 1000,
                          x_of(i) % 1000, y_of(i) / 1000, y_of(i) % 1000);
    }
    return text + "M2\n";
  }();
  return kText;
}

const std::string& tape_text() {
  static const std::string kText = [] {
    std::string text = "%\nF1000\n";
    for (std::int64_t i = 0; i < kBlocks; ++i) {
      text += fmt::format("{}X{}Y-{}\n", i % 4 == 0 ? "G00" : "", x_of(i), y_of(i));
    }
    return text + "M30\n";
  }();
  return kText;
}

/// Two hundred connected cuts, five thousand times over; `side`: TC, 0 for the tool on the line.
std::string event_text(int side) {
  std::string text = "PN1 G20 ;\n";
  for (int i = 0; i < 200; ++i) {
    text += fmt::format("N{} G101 XB{}.A YB{}.A XE{}.A YE{}.A F500 TC{} D0.25 CR{} ;\n", i, i % 90,
                        i % 7, (i + 1) % 90, (i + 1) % 7, side, i % 90 == 89 ? "-" : "0");
  }
  return text + "G105 FE1 LE200 XO0 YO.01 RE99 ;\nG105 FE201 LE201 XO.01 YO0 RE49 ;\n%\n";
}

void measure(benchmark::State& state, std::string_view control, const std::string& text) {
  double ours = 0;
  double ngc = 0;
  for (auto _ : state) {
    const double rate = rate_of(control, text);
    ours += rate;
    ngc += rate_of("rs274ngc", ngc_text());
    state.SetIterationTime(static_cast<double>(kBlocks) / rate);
  }
  state.counters["blocks_per_second"] = ours / static_cast<double>(state.iterations());
  state.counters["times_of_rs274ngc"] = ours / ngc;
}

void tektronix_straight_blocks(benchmark::State& state) {
  measure(state, "tektronix-1704", tape_text());
}
BENCHMARK(tektronix_straight_blocks)->UseManualTime()->Unit(benchmark::kMillisecond);

void prototrak_straight_events(benchmark::State& state) {
  measure(state, "prototrak-plus", event_text(0));
}
BENCHMARK(prototrak_straight_events)->UseManualTime()->Unit(benchmark::kMillisecond);

void prototrak_compensated_events(benchmark::State& state) {
  measure(state, "prototrak-plus", event_text(2));
}
BENCHMARK(prototrak_compensated_events)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dripline::interpreter
