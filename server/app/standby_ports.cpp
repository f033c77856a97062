#include "server/app/standby_ports.hpp"

#include "protocol/dds/configuration.hpp"

namespace dripline::app {

Result<void> StandbyPorts::check() {
  if (listener_) return dds::check_second_ports(network_);
  if (auto free = dds::check_ports(network_); !free) return free;
  auto listener = dds::GatewayListener::open(network_);
  if (!listener) return fail(listener.error());
  listener_ = *std::move(listener);
  return {};
}

std::optional<std::int64_t> StandbyPorts::gateways(SteadyTime now) const {
  if (!listener_) return std::nullopt;
  return static_cast<std::int64_t>(listener_->count(now));
}

}  // namespace dripline::app
