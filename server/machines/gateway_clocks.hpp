#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>

#include "protocol/base/clock.hpp"
#include "protocol/dds/message.hpp"

namespace dripline::machines {

/// How the clocks of one gateway compare with the server's, from the statuses it writes at least
/// once a second. A status is delayed in transit, so each comparison shows the gateway's clock at
/// most as far ahead as it is; the largest of the last ones is the best. Not thread-safe.
class GatewayClocks {
 public:
  static constexpr std::chrono::microseconds kTolerance{1'000'000};

  /// Another gateway took over: nothing is known of its clocks.
  void reset() { *this = {}; }
  void compare(const dds::Status& status, UtcTime now, SteadyTime steady_now);

  /// How far its steady clock is ahead of the server's, never overestimated.
  std::optional<std::chrono::microseconds> steady_ahead() const { return steady_ahead_; }
  /// How far its time of day is ahead of the server's; negative: after. None before kSamples
  /// comparisons.
  std::optional<std::chrono::microseconds> time_ahead() const;

 private:
  static constexpr std::size_t kSamples = 4;
  std::array<std::chrono::microseconds, kSamples> time_ahead_{};
  std::size_t count_ = 0;
  std::optional<std::chrono::microseconds> steady_ahead_;
};

}  // namespace dripline::machines
