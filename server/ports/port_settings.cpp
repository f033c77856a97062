#include "server/ports/port_settings.hpp"

#include <filesystem>

#include "protocol/wire/tnc_parameters.hpp"

namespace dripline::ports {

Result<wire::LineSettings> effective_settings(const storage::Port& port) {
  wire::LineSettings settings;
  if (!port.line_template.empty()) {
    const auto found = wire::find_template(port.line_template);
    if (!found) {
      return fail(found.error().code, "port '{}': {}", port.name, found.error().what);
    }
    settings = (*found)->settings;
  }
  for (const auto& [key, value] : port.settings) {
    if (auto set = wire::set_value(settings, key, value); !set) {
      return fail(set.error().code, "port '{}': {}", port.name, set.error().what);
    }
  }
  // A rate that the control's MOD function does not offer cannot be meant.
  if (port.is_enabled && template_control(port) == "tnc155") {
    if (auto has = wire::check_tnc_baud(settings.baud); !has) {
      return fail(has.error().code, "port '{}': {}", port.name, has.error().what);
    }
  }
  return settings;
}

std::string template_control(const storage::Port& port) {
  const auto found = wire::find_template(port.line_template);
  return found ? std::string((*found)->control) : std::string();
}

std::string line_identity(const std::string& address) {
  if (!address.starts_with('/')) return address;
  std::error_code ec;
  const auto real = std::filesystem::weakly_canonical(address, ec);
  return ec ? address : real.string();
}

}  // namespace dripline::ports
