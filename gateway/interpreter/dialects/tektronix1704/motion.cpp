#include "gateway/interpreter/dialects/tektronix1704/motion.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "gateway/interpreter/dialects/tektronix1704/path_rules.hpp"

namespace dripline::interpreter::tektronix1704 {
namespace {

constexpr std::int64_t kCapacity = 999'999;

/// The F word's value per minute, in the control's unit (manual: feedrate).
double feed_value(const ControlOptions& options, std::int32_t count) {
  if (options.units != UnitSet::Option1 || count == 0) return count * options.feed_per_count();
  if (options.option1_feed_is_doubled) return count * 0.2;
  return std::max(count / 2 * 2, 2) * 0.1;
}

void emit_line(Run& run, const Counts& to, Pace pace, double feed, bool rests) {
  State& state = run.state;
  for (std::size_t axis = 0; axis < run.options.axes; ++axis) {
    if (to[axis] == state.program[axis]) continue;
    run.position.set(static_cast<Axis>(axis),
                     Length::mm(run.machine_mm(axis, static_cast<double>(to[axis]))));
  }
  state.program = to;
  if (pace == Pace::Rapid) {
    run.events().on_rapid({run.origin, run.position});
  } else {
    run.events().on_line({run.origin, run.position, Feed::per_minute(Length::mm(feed)), rests});
  }
}

}  // namespace

bool load_feed(Run& run, std::int32_t count) {
  run.state.feed = count;
  const double value = feed_value(run.options, count);
  const bool is_fit = value <= run.options.max_feed * (1 + 1e-9) &&
                      (count == 0 || value >= run.options.min_feed * (1 - 1e-9));
  if (is_fit) [[likely]]
    return true;
  return run.object(Fault::FeedOutOfRange, 0,
                    fmt::format("F{} is {:g}, the range {:g} to {:g}", count, value,
                                run.options.min_feed, run.options.max_feed));
}

std::optional<double> feed_rate(Run& run) {
  if (run.state.feed <= 0) {
    run.fail(Fault::NoFeed);
    return std::nullopt;
  }
  const double value = feed_value(run.options, run.state.feed);
  return run.options.length(std::clamp(value, run.options.min_feed, run.options.max_feed)).mm();
}

bool check_point(Run& run, const Counts& point) {
  for (std::size_t axis = 0; axis < run.options.axes; ++axis) {
    const char name = letter(static_cast<Axis>(axis));
    if (std::abs(point[axis]) > kCapacity) [[unlikely]] {
      return run.fail(Fault::Capacity, 0,
                      fmt::format("{}{} is over {}", name, point[axis], kCapacity));
    }
    const AxisLimits& limits = run.options.travel[axis];
    if (!limits.low && !limits.high) [[likely]]
      continue;
    const std::int64_t machine =
        run.state.origin[axis] + (run.options.mirror[axis] ? -point[axis] : point[axis]);
    if ((limits.low && machine < *limits.low) || (limits.high && machine > *limits.high)) {
      return run.fail(Fault::Travel, 0, fmt::format("{} machine position {}", name, machine));
    }
  }
  return true;
}

bool move_line(Run& run, const LineMove& move) {
  if (move.to == run.state.program) return true;
  if (!check_point(run, move.to)) return false;
  double feed = run.options.length(run.options.rapid).mm();
  if (move.pace == Pace::Feed) {
    const auto rate = feed_rate(run);
    if (!rate) return false;
    feed = *rate;
  }
  PlannedMove planned{{}, {}, 0, feed, move.flows};
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    planned.begin[axis] = static_cast<double>(move.to[axis] - run.state.program[axis]);
  }
  planned.end = planned.begin;
  planned.length = std::hypot(planned.begin[0], planned.begin[1], planned.begin[2]);
  check_turn(run, planned);
  emit_line(run, move.to, move.pace, feed, !move.flows);
  return true;
}

bool move_depth(Run& run, double to, Pace pace) {
  const double feed = pace == Pace::Feed ? feed_rate(run).value_or(0) : 0;
  if (pace == Pace::Feed && feed <= 0) return false;
  const double there = run.machine_mm(kZ, to);
  if (there == run.position.raw(Axis::Z)) return true;
  run.position.set(Axis::Z, Length::mm(there));
  run.state.program[kZ] = std::llround(to);
  if (pace == Pace::Rapid) {
    run.events().on_rapid({run.origin, run.position});
  } else {
    run.events().on_line({run.origin, run.position, Feed::per_minute(Length::mm(feed)), true});
  }
  return true;
}

void round_to_steps(Run& run) {
  constexpr std::array kDimensions{Address::X, Address::Y, Address::Z, Address::I,
                                   Address::J, Address::K, Address::R};
  Words& words = run.state.block.words;
  for (const Address address : kDimensions) {
    if (!words.has(address) || words[address] % 2 == 0) continue;
    const std::int32_t count = words[address];
    run.warn(Fault::OddCount, run.origin, 0, fmt::format("{}", count));
    words.replace(address, count - (count > 0 ? 1 : -1));
  }
}

Counts end_point(const Run& run) {
  Counts point = run.state.program;
  const Words& words = run.state.block.words;
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    const auto address = static_cast<Address>(static_cast<std::size_t>(Address::X) + axis);
    if (!words.has(address)) continue;
    point[axis] = (run.state.is_incremental ? point[axis] : 0) + words[address];
  }
  return point;
}

bool move_block(Run& run) {
  State& state = run.state;
  if (state.motion == Motion::Cycle) return run_cycle(run);
  if (!state.block.words.has_any(kEndWords)) return true;
  run.ledger.take(kEndWords);
  if (is_arc(state.motion)) return move_arc(run);
  return move_line(run, {end_point(run), state.motion == Motion::G50 ? Pace::Rapid : Pace::Feed,
                         flows_on(state.motion)});
}

}  // namespace dripline::interpreter::tektronix1704
