#pragma once

#include <chrono>
#include <functional>
#include <optional>

#include "protocol/base/clock.hpp"
#include "protocol/dds/message.hpp"

namespace dripline::report {

/// Decides when a status goes out: on change, at most ten times a second, and once a second
/// without one. Pure; one thread.
class StatusPublisher {
 public:
  /// False: not taken, try later.
  using Send = std::function<bool(const dds::Status&)>;
  explicit StatusPublisher(Send send) : send_(std::move(send)) {}

  /// Whether a status offered now could go out: saves making one.
  bool is_due(SteadyTime now) const { return !last_ || now >= next_; }
  /// Sends `status` (all but its time is compared) when it is due.
  void offer(const dds::Status& status, SteadyTime now);
  /// A server has appeared, or is to know at once: the next offer goes out.
  void reset() { last_.reset(); }

  static constexpr std::chrono::milliseconds kMinInterval{100}, kMaxInterval{1000};

 private:
  Send send_;
  std::optional<dds::Status> last_;
  SteadyTime next_{}, sent_{};
};

}  // namespace dripline::report
