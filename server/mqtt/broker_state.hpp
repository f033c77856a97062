#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>

#include "protocol/base/clock.hpp"
#include "server/mqtt/broker_link.hpp"

namespace dripline::mqtt {

/// Whether a broker is reached, since when and why not; how long to wait for the next try. Of the
/// thread that has the connection, but for `view`.
class BrokerState {
 public:
  struct Options {
    std::chrono::milliseconds first_retry{500};
    std::chrono::milliseconds longest_retry{30'000};
    std::chrono::milliseconds long_fault{60'000};  ///< then it is a finding
    std::chrono::milliseconds fault_ends_after{
        60'000};  ///< connected: the fault is over, or all is there
  };
  /// What has been wrong for long; empty: nothing any more.
  using OnFault = std::function<void(const std::string& broker, const std::string& fault)>;
  struct View {
    bool is_connected = false;
    std::optional<UtcTime> since = {};  ///< it is connected, or not
    std::string fault;                  ///< why not, or what the connection before ended with
    std::uint64_t connections = 0;      ///< since the start
  };

  /// `who` begins what the log says.
  BrokerState(const Clock& clock, std::string who, std::string broker, Options options,
              OnFault on_fault);

  struct Patience {
    std::chrono::milliseconds look, limit;
  };
  /// Waits until the broker has accepted us, or `stop`. Errors: why it has not.
  Result<void> connect(BrokerLink& link, const Message& will, const std::string& subscribed,
                       Patience patience, const std::stop_token& stop) const;
  void set_connected();
  void set_lost(const std::string& fault);
  /// A connection alone does not end a fault: a broker that refuses a message accepts connections.
  void end_fault(bool has_caught_up);
  /// Until the next try.
  void pause(const std::stop_token& stop);
  View view() const;

 private:
  const Clock& clock_;
  const std::string who_;
  const std::string broker_;
  const Options options_;
  const OnFault on_fault_;

  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  View view_;

  // Of the thread.
  std::optional<UtcTime> failing_since_;
  unsigned failures_ = 0;
  SteadyTime connected_at_{};
};

}  // namespace dripline::mqtt
