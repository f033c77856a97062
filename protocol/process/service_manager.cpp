#include "protocol/process/service_manager.hpp"

#include <fmt/format.h>
#include <systemd/sd-daemon.h>
#include <algorithm>
#include <cstdlib>
#include <string>

namespace dripline::process {
namespace {

/// A line end would begin another field.
std::string field(std::string_view name, std::string_view text) {
  std::string line(text);
  std::ranges::replace(line, '\n', ' ');
  return fmt::format("{}={}", name, line);
}

}  // namespace

bool has_service_manager() {
  return std::getenv("NOTIFY_SOCKET") != nullptr;
}

void notify_ready(std::string_view status) {
  ::sd_notify(0, ("READY=1\n" + field("STATUS", status)).c_str());
}

void notify_stopping() {
  ::sd_notify(0, "STOPPING=1");
}

std::optional<std::chrono::microseconds> alive_interval() {
  std::uint64_t limit = 0;
  if (::sd_watchdog_enabled(0, &limit) <= 0) return std::nullopt;
  return std::chrono::microseconds(limit / 2);
}

void notify_alive(std::string_view status) {
  ::sd_notify(0, ("WATCHDOG=1\n" + field("STATUS", status)).c_str());
}

}  // namespace dripline::process
