#include <benchmark/benchmark.h>
#include <fmt/core.h>
#include <chrono>
#include <string>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"

/// Straight blocks of the TNC 155 in both forms, in proportion to straight RS274/NGC blocks in the
/// same run (at least half of their rate), and what compensation costs a block of a contour (at
/// most as much again).
namespace dripline::interpreter {
namespace {

constexpr std::int64_t kBlocks = 1'000'000;

class MoveSink final : public EventSink {
 public:
  void on_line(const Line& event) override { travel += event.to.linear(Axis::X).mm(); }
  void on_arc(const Arc& event) override { travel += event.to.linear(Axis::X).mm(); }
  void on_alarm(const Alarm& event) override { fault = event.diagnostic.text; }
  double travel = 0;
  std::string fault;
};

/// Blocks per second; a program that alarms makes the bench fail.
double rate_of(benchmark::State& state, std::string_view control, const std::string& text) {
  MemorySource source(text);
  MoveSink sink;
  auto interpreter = (*find_dialect(control))->make(Setup{}, source, sink);
  const auto start = std::chrono::steady_clock::now();
  while ((*interpreter)->step(65'536) == StepState::Ran) {
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  benchmark::DoNotOptimize(sink.travel);
  if (!sink.fault.empty()) state.SkipWithError(sink.fault.c_str());
  return static_cast<double>((*interpreter)->blocks()) / elapsed.count();
}

std::int64_t x_of(std::int64_t i) {
  return 10'000 + (i * 7919) % 90'000;
}
std::int64_t y_of(std::int64_t i) {
  return (i * 104'729) % 30'000;
}

template <class Format>
std::string blocks_text(std::string text, Format format, std::string_view end) {
  for (std::int64_t i = 0; i < kBlocks; ++i) text += format(i);
  text += end;
  return text;
}

const std::string& ngc_text() {
  static const std::string kText = blocks_text(
      "G21 G17 G90\nG94 F1000\nG1 X0 Y0\n",
      [](std::int64_t i) {
        return fmt::format("X{}.{:03} Y-{}.{:03}\n", x_of(i) / 1000, x_of(i) % 1000, y_of(i) / 1000,
                           y_of(i) % 1000);
      },
      "M2\n");
  return kText;
}
const std::string& plain_text() {
  static const std::string kText = blocks_text(
      "0 BEGIN PGM 1 MM\n1 L X+0,000 Y+0,000 R0 F1000 M\n",
      [](std::int64_t i) {
        return fmt::format("{} L X+{},{:03} Y-{},{:03}\n", i % 60'000 + 2, x_of(i) / 1000,
                           x_of(i) % 1000, y_of(i) / 1000, y_of(i) % 1000);
      },
      "65534 END PGM 1 MM\n");
  return kText;
}
const std::string& iso_text() {
  static const std::string kText = blocks_text(
      "%1 G71 *\nN1 G01 G17 G40 G90 X+0.000 Y+0.000 F1000 *\n",
      [](std::int64_t i) {
        return fmt::format("N{} X+{}.{:03} Y-{}.{:03} *\n", i % 60'000 + 2, x_of(i) / 1000,
                           x_of(i) % 1000, y_of(i) / 1000, y_of(i) % 1000);
      },
      "N65534 %1 G71 *\n");
  return kText;
}

/// A staircase of inside and outside corners.
std::string contour_text(std::string_view side) {
  std::string text =
      "0 BEGIN PGM 1 MM\n1 TOOL DEF 1 L+0,000 R+0,250\n2 TOOL CALL 1 Z S 100,000\n"
      "3 L X+0,000 Y-10,000 R0 F1000 M\n4 L X+0,000 Y+0,000 ";
  text += side;
  text += " F M\n";
  for (std::int64_t i = 0; i < kBlocks; ++i) {
    text += fmt::format("{} L X+{},000 Y+{},000\n", i % 60'000 + 5, (i / 2) % 1000 + 1,
                        ((i + 1) / 2) % 1000);
  }
  return text + "65533 L X+0,000 Y+0,000 R0\n65534 END PGM 1 MM\n";
}

void measure(benchmark::State& state, const std::string& text) {
  double ours = 0;
  double ngc = 0;
  for (auto _ : state) {
    ours = std::max(ours, rate_of(state, "tnc155", text));
    ngc = std::max(ngc, rate_of(state, "rs274ngc", ngc_text()));
  }
  state.counters["blocks_per_s"] = ours;
  state.counters["of_rs274ngc"] = ours / ngc;
}

void plain_blocks(benchmark::State& state) {
  measure(state, plain_text());
}
void iso_blocks(benchmark::State& state) {
  measure(state, iso_text());
}
void compensated_contour(benchmark::State& state) {
  const std::string off = contour_text("R0");
  const std::string on = contour_text("RL");
  double bare = 0;
  double offset = 0;
  for (auto _ : state) {
    bare = std::max(bare, rate_of(state, "tnc155", off));
    offset = std::max(offset, rate_of(state, "tnc155", on));
  }
  state.counters["blocks_per_s"] = offset;
  state.counters["times_the_bare_block"] = bare / offset;
}

BENCHMARK(plain_blocks)->Name("tnc155/plain")->Unit(benchmark::kMillisecond)->Iterations(3);
BENCHMARK(iso_blocks)->Name("tnc155/iso")->Unit(benchmark::kMillisecond)->Iterations(3);
BENCHMARK(compensated_contour)
    ->Name("tnc155/compensated")
    ->Unit(benchmark::kMillisecond)
    ->Iterations(3);

}  // namespace
}  // namespace dripline::interpreter
