// The body of PUT /ports/{name}. Property: what is taken is within every limit of a port.
#include <cstdlib>

#include "protocol/base/names.hpp"
#include "server/api/bodies/port_bodies.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  const auto port = api::decode_port("line-1", {reinterpret_cast<const char*>(data), size});
  if (!port) return port.error().what.empty() ? (std::abort(), 0) : 0;
  if (!check_machine_name(port->machine)) std::abort();
  if (port->address.empty() || port->address.size() > api::kMaxAddress) std::abort();
  if (port->settings.size() > storage::kMaxPortSettings) std::abort();
  if (port->rules.size() > storage::kMaxPortRules) std::abort();
  for (const auto& [key, value] : port->settings) {
    if (key.size() > api::kMaxSettingValue || value.size() > api::kMaxSettingValue) std::abort();
    if (key.find('\0') != std::string::npos || value.find('\0') != std::string::npos) std::abort();
  }
  return 0;
}
