#include <cmath>
#include <cstdint>
#include <span>

#include "gateway/interpreter/stages/compensation/compensator.hpp"

/// Any contour on a coarse grid, where corners coincide, touch and turn back all the time: what
/// comes out is finite, blocks end once and in order, and a state goes through its bytes unchanged.
namespace dripline::interpreter::compensation {
namespace {

void demand(bool holds) {
  if (!holds) __builtin_trap();
}

class Checker final : public EventSink {
 public:
  void on_rapid(const Rapid& event) override { check(event.to); }
  void on_line(const Line& event) override { check(event.to); }
  void on_arc(const Arc& event) override {
    check(event.to);
    demand(std::isfinite(event.center_first.mm()) && std::isfinite(event.center_second.mm()));
    demand(event.sweep.degrees() > 0 && event.sweep.degrees() < 1'000);
  }
  void on_block_end(const Origin& event) override { demand(event.block == ++ended); }
  std::uint64_t ended = 0;

 private:
  static void check(const Position& at) {
    for (const Axis axis : kAllAxes) demand(std::isfinite(at.raw(axis)));
  }
};

Policy policy_of(std::uint8_t bits) {
  Policy policy;
  policy.outside = static_cast<OutsideCorner>(bits % 3);
  policy.start_up = static_cast<StartUp>(bits / 3 % 3);
  policy.cancel = static_cast<Cancel>(bits / 9 % 2);
  policy.resume = static_cast<Resume>(bits / 18 % 2);
  policy.inside = static_cast<InsideCorner>(bits / 36 % 2);
  policy.blocks_without_motion = bits / 72;
  return policy;
}

double grid(std::uint8_t byte) {
  return static_cast<std::int8_t>(byte) * 0.5;
}

/// Three bytes an order: which one, and two numbers.
class Program {
 public:
  Program(std::uint8_t policy, Checker& sink) : compensator(policy_of(policy), sink) {}

  void order(std::span<const std::uint8_t, 3> bytes) {
    const double a = grid(bytes[1]);
    const double b = grid(bytes[2]);
    ++origin_.block;
    switch (bytes[0] % 8) {
      case 0:
        turn_on(a);
        break;
      case 1:
        bytes[2] % 4 == 3 ? round({a, b}) : compensator.turn_off();
        break;
      case 2:
        at_.set(Axis::Z, Length::mm(a));
        compensator.on_line({origin_, at_, feed_});
        break;
      case 3:
        bytes[1] % 2 ? compensator.cancel() : compensator.cancel_in_parallel();
        break;
      case 4:
        arc({a, b}, bytes[0]);
        break;
      default:
        straight(a, b, bytes[0] % 8 == 5);
    }
    compensator.on_block_end(origin_);
  }
  Compensator compensator;

 private:
  void turn_on(double radius) {
    if (compensator.is_waiting() || !compensator.fault())
      compensator.turn_on(
          {.radius = Length::mm(radius), .tip_first = Length::mm(0.5), .tip_second = {}});
  }
  void round(PlaneVector along) {
    const double size = length(along);
    if (size > 100) {
      compensator.round_outside_corner(origin_, feed_);
    } else if (size > 0) {
      compensator.round_outside_corner(origin_, feed_, (1 / size) * along);
    }
  }
  void straight(double x, double y, bool is_rapid) {
    at_.set(Axis::X, Length::mm(x));
    at_.set(Axis::Y, Length::mm(y));
    if (is_rapid) {
      compensator.on_rapid({origin_, at_});
    } else {
      compensator.on_line({origin_, at_, feed_});
    }
  }
  void arc(PlaneVector center, std::uint8_t turn) {
    const PlaneAxes axes = axes_of(Plane::XY);
    const PlaneVector out = in_plane(at_, axes) - center;
    if (length(out) == 0) return;
    const int steps = turn / 8 - 15;
    const Angle sweep = Angle::degrees(steps * 24.0);
    if (sweep == Angle{}) return;
    set_in_plane(
        at_, axes,
        center + std::cos(sweep.radians()) * out + std::sin(sweep.radians()) * left_of(out));
    compensator.on_arc({.origin = origin_,
                        .to = at_,
                        .center_first = Length::mm(center.first),
                        .center_second = Length::mm(center.second),
                        .plane = Plane::XY,
                        .turn = sweep > Angle{} ? Turn::Counterclockwise : Turn::Clockwise,
                        .sweep = sweep > Angle{} ? sweep : -sweep,
                        .feed = feed_});
  }
  Position at_;
  Origin origin_;
  Feed feed_ = Feed::inverse_time(3);
};

void run(std::span<const std::uint8_t> data) {
  Checker sink;
  Program program(data[0], sink);
  Compensator& compensator = program.compensator;
  std::uint64_t blocks = 0;
  for (data = data.subspan(1); data.size() >= 3 && !compensator.fault(); data = data.subspan(3)) {
    program.order(data.first<3>());
    ++blocks;
    if (compensator.fault()) return;
    const auto state = compensator.state();
    demand(compensator.restore(state).has_value() && compensator.state() == state);
  }
  compensator.flush();
  if (!compensator.fault()) demand(sink.ended == blocks);
}

}  // namespace
}  // namespace dripline::interpreter::compensation

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 1 && size < 1'000) dripline::interpreter::compensation::run({data, size});
  return 0;
}
