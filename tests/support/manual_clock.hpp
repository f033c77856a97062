#pragma once

#include <atomic>

#include "protocol/base/clock.hpp"

namespace dripline::test_support {

/// A clock the test moves. Any thread.
class ManualClock final : public Clock {
 public:
  UtcTime now() const override { return UtcTime{std::chrono::microseconds{now_us_}}; }
  SteadyTime steady_now() const override {
    return SteadyTime{std::chrono::microseconds{now_us_.load()}};
  }
  void advance(std::chrono::microseconds step) { now_us_ += step.count(); }

 private:
  std::atomic<std::int64_t> now_us_{1'700'000'000'000'000};
};

}  // namespace dripline::test_support
