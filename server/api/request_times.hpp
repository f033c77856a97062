#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>

namespace dripline::api {

/// How long the answers of each route took, as a histogram. Any thread; never waits for long.
class RequestTimes {
 public:
  using Duration = std::chrono::steady_clock::duration;
  /// Upper bounds of the buckets, in seconds; a last one without a bound follows.
  static constexpr std::array kBounds{0.001, 0.005, 0.025, 0.1, 0.5, 2.5, 10.0};

  struct Times {
    std::array<std::uint64_t, kBounds.size() + 1> counts{};  ///< per bucket, not cumulative
    double sum = 0;                                          ///< in seconds
  };

  /// `route`: method and pattern, `GET /api/v1/runs/{id}`.
  void add(const std::string& route, Duration taken);
  std::map<std::string, Times> all() const;

 private:
  mutable std::mutex mutex_;
  std::map<std::string, Times> times_;
};

}  // namespace dripline::api
