#include "server/machines/machine_notices.hpp"

#include <fmt/format.h>

#include "server/machines/gateway_clocks.hpp"

namespace dripline::machines {

std::string protocol_notice(std::uint32_t protocol) {
  if (protocol == dds::kProtocolVersion) return {};
  return fmt::format(
      "the gateway speaks protocol {}, this server {}: install the same version at both ends",
      protocol, dds::kProtocolVersion);
}

std::string clock_notice(std::chrono::microseconds ahead) {
  const auto distance = std::chrono::abs(ahead);
  if (distance <= GatewayClocks::kTolerance) return {};
  return fmt::format("the gateway's clock is {:.1f} s {} the server's",
                     std::chrono::duration<double>(distance).count(),
                     ahead.count() > 0 ? "ahead of" : "after");
}

std::vector<std::string> notices_of(const MachineView& view) {
  std::vector<std::string> notices;
  const auto add = [&notices](std::string notice) {
    if (!notice.empty()) notices.push_back(std::move(notice));
  };
  if (view.is_contested) add("two gateways claim to be this machine: stop one of them");
  if (view.protocol) add(protocol_notice(*view.protocol));
  if (view.is_connected && view.clock_ahead) add(clock_notice(*view.clock_ahead));
  return notices;
}

}  // namespace dripline::machines
