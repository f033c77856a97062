#pragma once

#include <string>

#include "gateway/app/options.hpp"
#include "gateway/report/outbox.hpp"
#include "protocol/base/clock.hpp"
#include "protocol/dds/endpoint.hpp"

namespace dripline::gateway {

/// What every gateway keeps of its server: whether it is there and commands it, the announcement it
/// is due, and what was dropped of its messages. One thread.
class ServerLink {
 public:
  struct Parts {
    const GatewayOptions& options;
    dds::GatewayEndpoint& endpoint;
    const report::Outbox& outbox;
    std::uint64_t session = 0;
  };
  /// All references must outlive it.
  explicit ServerLink(const Parts& parts) : parts_(parts) {}

  void on_server(bool is_connected);
  void on_refusal(const dds::Command& command);
  void want_announcement() { is_due_ = true; }
  /// Announces this gateway, if that is due.
  void announce();
  /// Dropped messages are logged once a minute at most: their sender must not fill the log.
  void log_rejected(SteadyTime now);

  bool is_connected() const { return is_connected_; }
  bool is_announced() const { return !is_due_; }
  /// Why the server does not command this gateway; empty: it does.
  const std::string& refused() const { return refused_; }

 private:
  Parts parts_;
  bool is_due_ = true, is_connected_ = false;
  std::string refused_;
  SteadyTime next_log_{};
  std::uint64_t logged_ = 0;
};

}  // namespace dripline::gateway
