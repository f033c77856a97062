#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/base/result.hpp"

namespace dripline {

/// Points in time are UTC microseconds since 1970; what is stored and sent is exactly this number.
using UtcTime = std::chrono::sys_time<std::chrono::microseconds>;
using SteadyTime = std::chrono::steady_clock::time_point;

/// Time comes in through this seam, so that tests own it. Implementations are safe on any thread.
class Clock {
 public:
  virtual ~Clock() = default;
  virtual UtcTime now() const = 0;
  virtual SteadyTime steady_now() const = 0;
};

class SystemClock final : public Clock {
 public:
  UtcTime now() const override;
  SteadyTime steady_now() const override { return std::chrono::steady_clock::now(); }
};

/// 2026-11-21T07:40:06.123456Z
std::string to_iso8601(UtcTime time);
/// The same, with up to six digits after the point or none, or a date alone (its beginning).
/// Errors: Syntax.
Result<UtcTime> parse_iso8601(std::string_view text);

/// Lets `burst` events pass in each interval and counts the rest, so that a log states the number
/// of omitted entries instead of growing with what a stranger sends. Not thread-safe.
class RateLimit {
 public:
  using Time = std::chrono::steady_clock::time_point;
  RateLimit(std::uint64_t burst, std::chrono::milliseconds interval)
      : burst_(burst), interval_(interval) {}

  /// The number of omitted events since the last one that passed; nullopt: omit this one too.
  std::optional<std::uint64_t> pass(Time now) {
    if (!begun_ || now - *begun_ >= interval_) {
      begun_ = now;
      passed_ = 0;
    }
    if (passed_ >= burst_) {
      ++left_out_;
      return std::nullopt;
    }
    ++passed_;
    const std::uint64_t left_out = left_out_;
    left_out_ = 0;
    return left_out;
  }

 private:
  const std::uint64_t burst_;
  const std::chrono::milliseconds interval_;
  std::optional<Time> begun_;
  std::uint64_t passed_ = 0;
  std::uint64_t left_out_ = 0;
};

}  // namespace dripline
