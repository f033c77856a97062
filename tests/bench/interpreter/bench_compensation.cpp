#include <benchmark/benchmark.h>
#include <fmt/core.h>
#include <string>

#include "clients/tools/offline/offline_run.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/stages/compensation/compensator.hpp"

/// What the compensation stage costs a block: moves through it while it is off, and while it
/// offsets a pocket of lines and arcs. The difference of the times per block is its price.
namespace dripline::interpreter::compensation {
namespace {

class CountingSink final : public EventSink {
 public:
  void on_line(const Line& event) override { sum += event.to.raw(Axis::X); }
  void on_arc(const Arc& event) override { sum += event.to.raw(Axis::X); }
  void on_block_end(const Origin&) override { ++blocks; }
  double sum = 0;
  std::int64_t blocks = 0;
};

/// Round a rectangle whose corners are rounded on three sides and square on the others.
class Pocket {
 public:
  explicit Pocket(Compensator& compensator) : compensator_(compensator) {}
  void start() { line(50, 0); }
  void lap() {
    line(90, 0);
    arc({100, 10}, {90, 10});
    line(100, 60);
    line(0, 60);
    line(0, 10);
    arc({10, 0}, {10, 10});
    line(50, 0);
  }

 private:
  void line(double x, double y) {
    set_in_plane(at_, axes_of(Plane::XY), {x, y});
    next();
    compensator_.on_line({origin_, at_, feed_});
    compensator_.on_block_end(origin_);
  }
  void arc(PlaneVector to, PlaneVector center) {
    set_in_plane(at_, axes_of(Plane::XY), to);
    next();
    compensator_.on_arc({.origin = origin_,
                         .to = at_,
                         .center_first = Length::mm(center.first),
                         .center_second = Length::mm(center.second),
                         .plane = Plane::XY,
                         .turn = Turn::Counterclockwise,
                         .sweep = Angle::degrees(90),
                         .feed = feed_});
    compensator_.on_block_end(origin_);
  }
  void next() { ++origin_.block; }

  Compensator& compensator_;
  Position at_;
  Origin origin_;
  Feed feed_ = Feed::per_minute(Length::mm(500));
};

constexpr int kLaps = 10'000;

void measure(benchmark::State& state, bool is_on) {
  CountingSink sink;
  for (auto _ : state) {
    Compensator compensator(Policy{}, sink);
    if (is_on) compensator.turn_on({.radius = Length::mm(4), .tip_first = {}, .tip_second = {}});
    Pocket pocket(compensator);
    pocket.start();
    for (int i = 0; i < kLaps; ++i) pocket.lap();
    if (compensator.fault()) state.SkipWithError("the pocket cannot be cut");
  }
  benchmark::DoNotOptimize(sink.sum);
  state.counters["blocks_per_second"] =
      benchmark::Counter(static_cast<double>(sink.blocks), benchmark::Counter::kIsRate);
}

void compensation_off(benchmark::State& state) {
  measure(state, false);
}
BENCHMARK(compensation_off)->Unit(benchmark::kMillisecond);

void compensation_on(benchmark::State& state) {
  measure(state, true);
}
BENCHMARK(compensation_on)->Unit(benchmark::kMillisecond);

/// The same contour as a program: `tests/bench/run` shows what compensation adds to a whole block.
std::string pocket_program(std::string_view start_up, std::string_view head = "O0001\n") {
  std::string text = fmt::format("{}G21G90G17\nG1{}X50.Y0F500.\n", head, start_up);
  for (int i = 0; i < kLaps; ++i) {
    text += "X90.\nG3X100.Y10.J10.\nG1Y60.\nX0\nY10.\nG3X10.Y0I10.\nG1X50.\n";
  }
  return text + "G40Y30.\nM30\n";
}

/// A round pocket, a quarter a block.
std::string circle_program(std::string_view start_up) {
  std::string text = fmt::format("O0001\nG21G90G17\nG1{}X50.Y0F500.\n", start_up);
  for (int i = 0; i < kLaps; ++i) {
    text += "G3X0Y50.I-50.\nX-50.Y0J-50.\nX0Y-50.I50.\nX50.Y0J50.\n";
  }
  return text + "G40G1Y30.\nM30\n";
}

void measure_program(benchmark::State& state, const std::string& text,
                     std::string_view name = "fanuc",
                     std::string_view settings = "[[tool]]\nnumber = 1\nradius = 4.0\n") {
  const Dialect& control = **find_dialect(name);
  auto setup = parse_setup(settings, control.units);
  CountingSink sink;
  for (auto _ : state) {
    MemorySource source(text);
    const auto outcome = run_offline(control, *setup, source, sink);
    if (!outcome || outcome->alarm) state.SkipWithError("the pocket cannot be cut");
  }
  benchmark::DoNotOptimize(sink.sum);
  state.counters["blocks_per_second"] =
      benchmark::Counter(static_cast<double>(sink.blocks), benchmark::Counter::kIsRate);
}

void fanuc_contour(benchmark::State& state) {
  measure_program(state, pocket_program(""));
}
BENCHMARK(fanuc_contour)->Unit(benchmark::kMillisecond);

void fanuc_contour_compensated(benchmark::State& state) {
  measure_program(state, pocket_program("G41D1"));
}
BENCHMARK(fanuc_contour_compensated)->Unit(benchmark::kMillisecond);

void fanuc_arcs(benchmark::State& state) {
  measure_program(state, circle_program(""));
}
BENCHMARK(fanuc_arcs)->Unit(benchmark::kMillisecond);

void fanuc_arcs_compensated(benchmark::State& state) {
  measure_program(state, circle_program("G41D1"));
}
BENCHMARK(fanuc_arcs_compensated)->Unit(benchmark::kMillisecond);

constexpr std::string_view kLinuxCnc = "[control]\nprofile = \"linuxcnc\"\n";

void linuxcnc_contour(benchmark::State& state) {
  measure_program(state, pocket_program("", ""), "rs274ngc", kLinuxCnc);
}
BENCHMARK(linuxcnc_contour)->Unit(benchmark::kMillisecond);

void linuxcnc_contour_compensated(benchmark::State& state) {
  measure_program(state, pocket_program("G41.1D8", ""), "rs274ngc", kLinuxCnc);
}
BENCHMARK(linuxcnc_contour_compensated)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dripline::interpreter::compensation
