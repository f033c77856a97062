#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <optional>

#include "gateway/interpreter/core/machine_data.hpp"

namespace dripline::interpreter {

inline constexpr double kSecondsPerMinute = 60;

/// A move as the clock needs it. By axis: millimeters, or degrees of a rotary one.
struct TimedMove {
  using Coordinates = std::array<double, kAxisCount>;
  std::uint64_t tag = 0;  ///< the owner's
  double length = 0;
  double speed = 0;              ///< wanted, per second
  bool is_rapid = false;         ///< as fast as the axes go, where all of them state a rate
  Coordinates begins{}, ends{};  ///< change of the axes by one unit of length, at either end
  Coordinates share{};           ///< the largest such change on the path, without its sign
  double radius = 0;             ///< of an arc, else 0
  Axis first = Axis::X, second = Axis::Y;  ///< of an arc's plane
};

/// The time that moves take with the accelerations and rates that a setup states for the axes:
/// ramps at rest and where the speed changes, corners passed at the speed of the circle that leaves
/// them by kCornerDeviation, as the simulated machine has it. Looks ahead by kWindow moves. One
/// thread; bounded memory.
class MotionClock {
 public:
  static constexpr std::size_t kWindow = 1024;
  static constexpr double kCornerDeviation = 0.02;  ///< mm

  /// `on_timed`: a move's time is known; in their order.
  using OnTimed = std::function<void(std::uint64_t tag, double seconds)>;
  MotionClock(const MachineData& machine, OnTimed on_timed);

  /// Whether the machine states an acceleration at all: without one this is no clock.
  static bool is_stated(const MachineData& machine);

  void add(const TimedMove& move);
  /// The axes rest before what follows.
  void stop();
  /// Of the oldest move whose time is not known yet.
  std::uint64_t first_open() const {
    return queue_.empty() ? std::numeric_limits<std::uint64_t>::max() : queue_.front().tag;
  }

 private:
  struct Item {
    std::uint64_t tag = 0;
    double length = 0, speed = 0, acceleration = 0;
    double corner_square = 0;  ///< highest speed at its start, squared
    double exit_square = 0;    ///< likewise at its end, by what follows
  };
  double corner_square(const TimedMove& move, double acceleration) const;
  void plan();
  void finish(std::size_t count);
  double seconds_of(const Item& item);

  std::array<double, kAxisCount> acceleration_{}, rate_{};  ///< per second; infinite: not stated
  OnTimed on_timed_;
  std::deque<Item> queue_;
  double entry_ = 0;            ///< speed at the start of the queue
  bool has_direction_ = false;  ///< of the move before:
  TimedMove::Coordinates direction_{};
  double last_acceleration_ = 0, last_length_ = 0;
};

}  // namespace dripline::interpreter
