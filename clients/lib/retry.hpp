#pragma once

#include <algorithm>
#include <chrono>
#include <functional>

namespace dripline::client {

/// How long a transfer retries when the server does not answer. The wait doubles from `first` to
/// `longest`; any progress resets it.
struct RetryPolicy {
  std::chrono::milliseconds first{100};
  std::chrono::milliseconds longest{3000};
  int attempts = 10;  ///< in a row without progress; with the values above about 20 s
  /// Waits; false when the user ends the transfer. Injected so that tests need no time.
  std::function<bool(std::chrono::milliseconds)> wait;
};

/// Counts the failures in a row and computes the wait before the next attempt.
class BackOff {
 public:
  explicit BackOff(const RetryPolicy& policy) : policy_(policy) {}

  void reset() { failures_ = 0; }
  /// Waits before the next attempt; false when there is none.
  bool wait() {
    if (++failures_ > policy_.attempts) return false;
    const auto delay =
        std::min(policy_.longest, policy_.first * (1 << std::min(failures_ - 1, 16)));
    return !policy_.wait || policy_.wait(delay);
  }

 private:
  const RetryPolicy& policy_;
  int failures_ = 0;
};

}  // namespace dripline::client
