#pragma once

#include <memory>
#include <optional>

#include "protocol/dds/gateway_listener.hpp"

namespace dripline::app {

/// The UDP ports of a server that waits: the first one of each cell is its own meanwhile, and what
/// gateways send there is counted; of the others is asked whether they are free. One thread.
class StandbyPorts {
 public:
  explicit StandbyPorts(dds::NetworkOptions network) : network_(std::move(network)) {}
  /// Errors: Busy (a port is in use).
  Result<void> check();
  void receive(SteadyTime now) {
    if (listener_) listener_->receive(now);
  }
  /// nullopt: it does not listen, because a port is in use.
  std::optional<std::int64_t> gateways(SteadyTime now) const;

 private:
  const dds::NetworkOptions network_;
  std::unique_ptr<dds::GatewayListener> listener_;
};

}  // namespace dripline::app
