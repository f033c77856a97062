#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

#include "protocol/wire/discipline.hpp"

namespace dripline::serial {

/// Computes how many characters may go to a driver so that it never holds more than kWindow
/// character times and never runs empty. Each character leaves at the line's rate; if the driver
/// reports how many it still has, the larger number applies. Pure.
class Pacer {
 public:
  static constexpr std::size_t kWindow = 2;

  explicit Pacer(std::chrono::nanoseconds character_time) : time_(character_time) {}

  /// Characters that may go to the driver now. `unsent`: the number that the driver reports.
  std::size_t allowance(wire::LineTime now, std::optional<std::size_t> unsent) const;
  void handed_over(std::size_t count, wire::LineTime now);
  /// The time at which more characters may go.
  wire::LineTime next(wire::LineTime now, std::optional<std::size_t> unsent) const;
  std::chrono::nanoseconds character_time() const { return time_; }

 private:
  std::size_t computed(wire::LineTime now) const;

  std::chrono::nanoseconds time_;
  wire::LineTime empty_at_{};  ///< when the last character in the driver will have left
};

}  // namespace dripline::serial
