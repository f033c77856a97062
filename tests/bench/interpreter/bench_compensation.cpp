#include <benchmark/benchmark.h>
#include <cmath>

#include "gateway/interpreter/compensation/compensator.hpp"

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
                         .turn = Turn::CounterClockwise,
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
    if (compensator.fault()) state.SkipWithError("the pocket can not be cut");
  }
  benchmark::DoNotOptimize(sink.sum);
  state.counters["blocks_per_second"] =
      benchmark::Counter(static_cast<double>(sink.blocks), benchmark::Counter::kIsRate);
}

void CompensationOff(benchmark::State& state) {
  measure(state, false);
}
BENCHMARK(CompensationOff)->Unit(benchmark::kMillisecond);

void CompensationOn(benchmark::State& state) {
  measure(state, true);
}
BENCHMARK(CompensationOn)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dripline::interpreter::compensation
