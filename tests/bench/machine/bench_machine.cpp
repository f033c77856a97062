#include <benchmark/benchmark.h>
#include <cmath>

#include "gateway/machine/simulated_machine.hpp"

/// How fast the machine takes and executes blocks at "max" speed, without an interpreter. The queue
/// is kept full, as the gateway keeps it, so every move is planned with the whole look-ahead.
namespace dripline::machine {
namespace {

using interpreter::Axis;
using interpreter::Origin;
using interpreter::Position;

constexpr std::uint64_t kBlocks = 1'000'000;

class Counter final : public ExecutionSink {
 public:
  std::uint64_t blocks = 0;
  void on_block_executed(const Origin&) override { ++blocks; }
};

Position point(double x, double z) {
  Position position;
  position.set(Axis::X, Length::mm(x));
  position.set(Axis::Z, Length::mm(z));
  return position;
}

enum class Shape { Straight, Contour, ZigZag, Arcs };

void queue_block(interpreter::EventSink& events, Shape shape, const Origin& origin) {
  const auto n = static_cast<double>(origin.block);
  const Feed feed = Feed::per_minute(Length::mm(1200));
  switch (shape) {
    case Shape::Straight:
      events.on_line({origin, point(20, -0.01 * n), feed});
      break;
    case Shape::Contour:
      events.on_line({origin, point(20 + std::sin(n * 0.002), -0.01 * n), feed});
      break;
    case Shape::ZigZag:
      events.on_line({origin, point(origin.block % 2 == 0 ? 20 : 20.5, -0.01 * n), feed});
      break;
    case Shape::Arcs:
      events.on_arc({.origin = origin,
                     .to = point(20, -0.2 * n),
                     .center_first = Length::mm(-0.2 * n + 0.1),
                     .center_second = Length::mm(20),
                     .plane = interpreter::Plane::ZX,
                     .turn = interpreter::Turn::Counterclockwise,
                     .sweep = Angle::degrees(180),
                     .feed = feed});
      break;
  }
  events.on_block_end(origin);
}

void execute(benchmark::State& state, Shape shape, std::size_t ahead) {
  double machine_seconds = 0;
  for (auto _ : state) {
    Counter counter;
    SimulatedMachine machine(MachineLimits::lathe(), {}, counter);
    machine.begin(point(20, 0));
    Origin origin;
    machine_seconds = 0;
    while (origin.block < kBlocks) {
      while (origin.block < kBlocks && machine.status().queued < ahead) {
        ++origin.block;
        queue_block(machine.events(), shape, origin);
      }
      machine_seconds += machine.poll_all(ahead / 2).count();
    }
    machine_seconds += machine.poll_all().count();
    if (counter.blocks != kBlocks) state.SkipWithError("blocks were lost");
  }
  state.counters["blocks_per_second"] =
      benchmark::Counter(static_cast<double>(kBlocks) * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate);
  state.counters["machine_seconds"] = machine_seconds;
}

BENCHMARK_CAPTURE(execute, straight, Shape::Straight, 8000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(execute, contour, Shape::Contour, 8000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(execute, zigzag, Shape::ZigZag, 8000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(execute, arcs, Shape::Arcs, 8000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(execute, contour_64_ahead, Shape::Contour, 64)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dripline::machine
