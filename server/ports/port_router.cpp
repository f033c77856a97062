#include "server/ports/port_router.hpp"

#include <algorithm>

namespace dripline::ports {

bool PortRouter::is_gateways(const std::string& name) const {
  return !own_.port(name) && gateways_.has(name);
}

namespace {

tl::unexpected<Error> set_up_there(const std::string& name) {
  return fail(Errc::Unsupported,
              "line '{}' is its gateway's own: it is set up there (dncgw --motion line:...)", name);
}

}  // namespace

std::vector<PortView> PortRouter::ports() const {
  auto views = own_.ports();
  for (auto& view : gateways_.ports()) {
    const bool is_hidden = std::ranges::any_of(
        views, [&](const PortView& own) { return own.port.name == view.port.name; });
    if (!is_hidden) views.push_back(std::move(view));
  }
  std::ranges::sort(views, {}, [](const PortView& view) { return view.port.name; });
  return views;
}

Result<PortView> PortRouter::port(const std::string& name) const {
  if (auto own = own_.port(name)) return own;
  return gateways_.port(name);
}

Result<PortView> PortRouter::save(const storage::Port& port) {
  if (is_gateways(port.name)) return set_up_there(port.name);
  return own_.save(port);
}

Result<void> PortRouter::remove(const std::string& name) {
  if (is_gateways(name)) return set_up_there(name);
  return own_.remove(name);
}

Result<PortTest> PortRouter::test(const std::string& name) {
  return is_gateways(name) ? gateways_.test(name) : own_.test(name);
}

Result<PortTransfer> PortRouter::send(const std::string& name,
                                      const std::vector<ProgramChoice>& programs) {
  return is_gateways(name) ? gateways_.send(name, programs) : own_.send(name, programs);
}

Result<std::string> PortRouter::confirm_reset(const std::string& name) {
  return is_gateways(name) ? gateways_.confirm_reset(name) : own_.confirm_reset(name);
}

Result<void> PortRouter::receive(const std::string& name) {
  return is_gateways(name) ? gateways_.receive(name) : own_.receive(name);
}

Result<void> PortRouter::stop_transfer(const std::string& name, const std::string& reason) {
  return is_gateways(name) ? gateways_.stop_transfer(name, reason)
                           : own_.stop_transfer(name, reason);
}

Result<RuleVerdict> PortRouter::test_rules(const std::string& name, const std::string& text) const {
  return is_gateways(name) ? gateways_.test_rules(name, text) : own_.test_rules(name, text);
}

Result<std::vector<PortTraffic>> PortRouter::recording(const std::string& name) const {
  return is_gateways(name) ? gateways_.recording(name) : own_.recording(name);
}

}  // namespace dripline::ports
