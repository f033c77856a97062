// What people are to know of a machine and its gateway, in sentences, and what is news of it.
#include <tuple>

#include <fmt/format.h>

#include "server/machines/machine_registry.hpp"

namespace dripline::machines {

bool is_news(const dds::Status& before, const dds::Status& now) {
  const auto compared = [](const dds::Status& s) {
    return std::tie(s.execution, s.mode, s.run, s.program, s.message, s.single_block,
                    s.emergency_stop, s.remote_enable, s.waits_for, s.feed_override,
                    s.rapid_override, s.spindle_override, s.session, s.axes, s.switches, s.jog);
  };
  return compared(before) != compared(now) ||
         before.serial_line.has_value() != now.serial_line.has_value();
}

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

std::string silence_notice(const MachineView& view) {
  if (!view.is_stale) return {};
  const std::string since = view.status_taken ? " since " + to_iso8601(*view.status_taken) : "";
  return fmt::format(
      "the gateway is connected, but no status of it has arrived{}: what is shown may be wrong, "
      "look at the machine; only stops are sent to it",
      since);
}

std::string stranger_notice(const MachineView& view) {
  if (!view.unconfirmed_gateway) return {};
  const std::string run =
      view.status && !view.status->run.empty() ? fmt::format("run {}", view.status->run) : "a run";
  return fmt::format(
      "another gateway (version {}) claims to be this machine, and {} may be in progress at the "
      "one before: it is not taken. Stop it; or, when that run is over and this is the machine's "
      "gateway, confirm it (dnc machine confirm-gateway {})",
      *view.unconfirmed_gateway, run, view.machine.name);
}

std::string switch_notice(const MachineView& view) {
  if (view.lost_switches.empty()) return {};
  return fmt::format(
      "the gateway was restarted, and {}, on before, is off: a start moves the machine",
      view.lost_switches);
}

std::vector<std::string> notices_of(const MachineView& view) {
  std::vector<std::string> notices;
  const auto add = [&notices](std::string notice) {
    if (!notice.empty()) notices.push_back(std::move(notice));
  };
  if (view.is_contested) add("two gateways claim to be this machine: stop one of them");
  add(silence_notice(view));
  add(stranger_notice(view));
  if (view.protocol) add(protocol_notice(*view.protocol));
  if (view.is_connected && view.clock_ahead) add(clock_notice(*view.clock_ahead));
  return notices;
}

}  // namespace dripline::machines
