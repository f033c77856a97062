#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "protocol/base/clock.hpp"
#include "protocol/dds/endpoint.hpp"

namespace dripline::feeds {

/// Sends orders and waits for their results. Every order has an id and an expiry, so that one that
/// was delayed on its way is never carried out late.
class OrderDesk {
 public:
  struct Options {
    std::chrono::milliseconds expiry{5000};
    std::chrono::milliseconds grace{1000};  ///< for a result given just before the expiry
    /// An order without an answer is sent again, with the same id, to the gateway that speaks now:
    /// the first may have been lost with a connection, or been meant for a gateway that has just
    /// been replaced.
    std::chrono::milliseconds repeat{250};
    /// The session that speaks for a machine now; absent: orders keep theirs.
    std::function<std::uint64_t(const std::string& machine)> session_of{};
  };
  /// `on_late_start`: a start was accepted after its sender gave up; called on a DDS thread.
  OrderDesk(dds::ServerEndpoint& endpoint, const Clock& clock, Options options,
            std::function<void(const dds::Order&)> on_late_start);

  /// Gives the order an id and an expiry, sends it and waits. Any thread but DDS's. Errors: Busy
  /// (refused: the gateway's reason), Timeout (nothing heard in time), NotFound (never announced),
  /// Io (the server is stopping).
  Result<void> carry_out(dds::Order order);
  /// Without waiting for the result; for orders of our own.
  Result<void> send(dds::Order order);

  /// On a DDS thread; returns at once.
  void on_result(const dds::OrderResult& result);
  /// The machine shows this run: its start was accepted, even if the result was lost.
  void on_run_seen(const std::string& run);
  /// Is somebody waiting for the start of this run?
  bool is_waiting_for(const std::string& run) const;
  void stop();

 private:
  struct Waiting {
    dds::Order order;
    std::optional<dds::OrderResult> result;
  };
  void stamp(dds::Order& order) const;
  Result<void> write_in_time(const dds::Order& order);
  Result<void> await(const std::string& id);
  void repeat(dds::Order order);

  dds::ServerEndpoint& endpoint_;
  const Clock& clock_;
  const Options options_;
  const std::function<void(const dds::Order&)> on_late_start_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, Waiting> waiting_;
  std::deque<dds::Order> given_up_;  ///< starts without an answer, the newest kMaxGivenUp
  bool is_stopping_ = false;
};

}  // namespace dripline::feeds
