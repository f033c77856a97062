#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

#include "protocol/wire/discipline.hpp"

namespace dripline::serial {

/// When how many characters may be handed to a driver so that it never holds more than kWindow
/// character times, and yet never runs dry. It reckons when each character will have left at the
/// line's own rate; where the driver tells what it still has, the worse of both counts. Pure.
class Pacer {
 public:
  static constexpr std::size_t kWindow = 2;

  explicit Pacer(std::chrono::nanoseconds character_time) : time_(character_time) {}

  /// Characters that may be handed over now. `unsent`: what the driver says it has.
  std::size_t allowance(wire::LineTime now, std::optional<std::size_t> unsent) const;
  void handed_over(std::size_t count, wire::LineTime now);
  /// When the allowance grows next.
  wire::LineTime next(wire::LineTime now, std::optional<std::size_t> unsent) const;
  std::chrono::nanoseconds character_time() const { return time_; }

 private:
  std::size_t reckoned(wire::LineTime now) const;

  std::chrono::nanoseconds time_;
  wire::LineTime empty_at_{};  ///< when the last character handed over will have left
};

}  // namespace dripline::serial
