#include "server/ports/port_settings.hpp"

#include <filesystem>

#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/control_version.hpp"
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

namespace tnc155 = interpreter::tnc155;

Result<void> check_protocol(storage::SetupStore& store, const std::string& machine,
                            wire::Flow flow) {
  if (flow != wire::Flow::HeidenhainBcc) return {};
  const auto stored = store.find(machine, std::nullopt);
  if (!stored) return {};
  const auto setup = interpreter::parse_control_data(stored->text);
  // Options of another control are no question here.
  const auto version = setup ? tnc155::version_of(setup->control)
                             : Result<tnc155::ControlVersion>(fail(setup.error()));
  if (!version || version->has(tnc155::Feature::BlockwiseTransfer)) return {};
  return fail(Errc::Unsupported,
              "machine '{}', setup {}: {}; flow heidenhain (template tnc155) is its interface",
              machine, stored->number, version->lacks(tnc155::Feature::BlockwiseTransfer));
}

}  // namespace dripline::ports
