#pragma once

#include <functional>
#include <optional>
#include <string>

#include "gateway/app/options.hpp"
#include "gateway/report/outbox.hpp"
#include "gateway/report/record_sender.hpp"
#include "gateway/report/status_publisher.hpp"
#include "protocol/base/clock.hpp"
#include "protocol/dds/endpoint.hpp"

namespace dripline::gateway {

/// Every gateway's link to its server: whether it is there and commands this gateway, the
/// announcement it is due, the records that wait for it, the status, and what was dropped of its
/// messages. One thread.
class ServerLink {
 public:
  struct Parts {
    const GatewayOptions& options;
    dds::GatewayEndpoint& endpoint;
    report::Outbox& outbox;
    std::uint64_t session = 0;
  };
  /// All references must outlive it.
  explicit ServerLink(const Parts& parts);
  ServerLink(const ServerLink&) = delete;
  ServerLink& operator=(const ServerLink&) = delete;

  void on_server(bool is_connected);
  void on_refusal(const dds::Command& command);
  void on_ack(const dds::RecordAck& ack, SteadyTime now) { sender_.on_ack(ack, now); }
  /// The next status goes out, whatever it is.
  void want_status() { publisher_.reset(); }

  /// Announces this gateway, if that is due.
  void announce();
  /// Sends the committed records that are due.
  void send_records(SteadyTime now);
  /// Sends the status that `make` makes, if one is due.
  void send_status(SteadyTime now, const std::function<dds::Status()>& make);
  /// When `send_records` has something to do without anything else happening.
  std::optional<SteadyTime> next_poll() const { return sender_.next_poll(); }

  bool is_connected() const { return is_connected_; }
  bool is_announced() const { return !is_due_; }
  /// Why the server does not command this gateway; empty: it does.
  const std::string& refused() const { return refused_; }

 private:
  void log_rejected(SteadyTime now);
  void log_silence(SteadyTime now);

  Parts parts_;
  report::RecordSender sender_;
  report::StatusPublisher publisher_;
  bool is_due_ = true, is_connected_ = false;
  std::string refused_;
  std::optional<SteadyTime> begun_;  ///< of the first turn
  bool was_connected_ = false;       ///< once, or its silence is in the log
  SteadyTime next_log_{};
  std::uint64_t logged_ = 0;
};

}  // namespace dripline::gateway
