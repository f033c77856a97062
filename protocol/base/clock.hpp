#pragma once

#include <chrono>
#include <cstdint>
#include <string>

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

}  // namespace dripline
