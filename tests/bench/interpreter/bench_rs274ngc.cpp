#include <benchmark/benchmark.h>
#include <fmt/core.h>
#include <sys/resource.h>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"

/// Blocks per second of the profile `linuxcnc`, how many times that is what Debian's stand-alone
/// `rs274 -g` does with the same text in the same run (its calls go to /dev/null), and how far it
/// is from merely reading the bytes that are executed.
namespace dripline::interpreter {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPeer = "/usr/bin/rs274";

class MoveCounter final : public EventSink {
 public:
  void on_rapid(const Rapid& event) override { count(event.to); }
  void on_line(const Line& event) override { count(event.to); }
  void on_arc(const Arc& event) override { count(event.to); }
  void on_alarm(const Alarm& event) override { alarm = event.diagnostic.text; }
  std::uint64_t moves = 0;
  double travel = 0;
  std::string alarm;

 private:
  void count(const Position& to) {
    ++moves;
    travel += to.linear(Axis::X).mm();
  }
};

/// Processor time, so that what else the machine does is not in the ratios.
double own_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}
double children_seconds() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

struct Workload {
  std::string text;
  std::uint64_t passes = 1;  ///< how often its bytes are executed
};

Workload straight() {
  constexpr std::int64_t kBlocks = 1'000'000;
  std::string text = "G21 G17 G90\nG94 F1000\n";
  for (std::int64_t i = 0; i < kBlocks; ++i) {
    const std::int64_t x = 10'000 + (i * 7919) % 90'000;
    const std::int64_t y = (i * 104'729) % 30'000;
    text += fmt::format("{}X{}.{:03} Y-{}.{:03}\n", i % 4 == 0 ? "G1 " : "", x / 1000, x % 1000,
                        y / 1000, y % 1000);
  }
  return {text + "M2\n"};
}

Workload arcs() {
  constexpr std::int64_t kBlocks = 300'000;
  std::string text = "G21 G17 G91\nG94 F1000\n";
  for (std::int64_t i = 0; i < kBlocks; ++i) {
    const std::int64_t first = 1 + (i * 37) % 9000;
    const std::int64_t second = 1 + (i * 101) % 9000;
    text += fmt::format("G{} X{}.{:03} Y{}.{:03} I{}.{:03} J{}.{:03}\n", 2 + i % 2,
                        2 * first / 1000, 2 * first % 1000, 2 * second / 1000, 2 * second % 1000,
                        first / 1000, first % 1000, second / 1000, second % 1000);
  }
  return {text + "M2\n"};
}

Workload loops() {
  constexpr std::uint64_t kPasses = 200'000;
  const std::string body =
      "o1 while [#1 lt 200000]\n#2=[#1*0.5+SIN[#1]]\no2 if [#2 gt 90000]\n#2=0\no2 endif\n"
      "G1 X#2 Y[#1/3]\n#1=[#1+1]\no1 endwhile\n";
  return {"G21 G17 G90\nG94 F1000\n#1=0\n" + body + "M2\n", kPasses};
}

double seconds_of_ours(const std::string& text, std::uint64_t& blocks) {
  static const Setup kSetup = *parse_setup("[control]\nprofile = \"linuxcnc\"\n");
  MemorySource source(text);
  MoveCounter counter;
  auto interpreter = (*find_dialect("rs274ngc"))->make(kSetup, source, counter);
  const double start = own_seconds();
  while ((*interpreter)->step(65'536) == StepState::Ran) {
  }
  const double seconds = own_seconds() - start;
  if (!counter.alarm.empty()) fmt::print(stderr, "alarm: {}\n", counter.alarm);
  benchmark::DoNotOptimize(counter.travel);
  blocks = (*interpreter)->blocks();
  return seconds;
}

/// 0 where the peer is not installed.
double seconds_of_peer(const std::string& text) {
  if (!fs::exists(kPeer)) return 0;
  const fs::path file = fs::temp_directory_path() / fmt::format("bench-{}.ngc", text.size());
  std::ofstream(file, std::ios::binary) << text;
  const std::string command = fmt::format("'{}' -g '{}' >/dev/null 2>&1", kPeer, file.string());
  const double start = children_seconds();
  const int status = std::system(command.c_str());
  const double seconds = children_seconds() - start;
  fs::remove(file);
  if (status != 0) fmt::print(stderr, "the peer ends with {}\n", status);
  return seconds;
}

double seconds_of_scan(const Workload& workload) {
  const double start = own_seconds();
  std::uint64_t lines = 0;
  for (std::uint64_t pass = 0; pass < workload.passes; ++pass) {
    for (const char c : workload.text) lines += c == '\n';
    benchmark::DoNotOptimize(lines);
  }
  return own_seconds() - start;
}

void measure(benchmark::State& state, const Workload& workload) {
  const double peer = seconds_of_peer(workload.text);
  std::uint64_t blocks = 0;
  double ours = 0;
  double scanned = 0;
  for (auto _ : state) {
    const double seconds = seconds_of_ours(workload.text, blocks);
    state.SetIterationTime(seconds);
    ours += seconds;
    scanned += seconds_of_scan(workload);
  }
  const auto runs = static_cast<double>(state.iterations());
  state.counters["blocks_per_second"] = static_cast<double>(blocks) * runs / ours;
  state.counters["times_of_memory_scan"] = ours / scanned;
  if (peer > 0) state.counters["times_faster_than_peer"] = peer * runs / ours;
}

void rs274ngc_straight_blocks(benchmark::State& state) {
  static const Workload kWorkload = straight();
  measure(state, kWorkload);
}
BENCHMARK(rs274ngc_straight_blocks)->UseManualTime()->Unit(benchmark::kMillisecond);

void rs274ngc_arcs(benchmark::State& state) {
  static const Workload kWorkload = arcs();
  measure(state, kWorkload);
}
BENCHMARK(rs274ngc_arcs)->UseManualTime()->Unit(benchmark::kMillisecond);

void rs274ngc_loops(benchmark::State& state) {
  static const Workload kWorkload = loops();
  measure(state, kWorkload);
}
BENCHMARK(rs274ngc_loops)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dripline::interpreter
