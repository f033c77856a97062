#include "server/ports/machine_router.hpp"

#include <map>

namespace dripline::ports {

std::vector<machines::MachineView> MachineRouter::machines() const {
  std::map<std::string, machines::MachineView> views;
  for (auto& view : gateways_.machines()) {
    const std::string name = view.machine.name;
    views.emplace(name, std::move(view));
  }
  for (auto& view : lines_.machines()) {
    const std::string name = view.machine.name;
    const auto gateway = views.find(name);
    view.is_contested = gateway != views.end() && gateway->second.is_connected;
    views.insert_or_assign(name, std::move(view));
  }
  std::vector<machines::MachineView> ordered;
  ordered.reserve(views.size());
  for (auto& [name, view] : views) ordered.push_back(std::move(view));
  return ordered;
}

Result<machines::MachineView> MachineRouter::machine(const std::string& name) const {
  auto gateway = gateways_.machine(name);
  auto line = lines_.machine(name);
  if (!line) return gateway;
  line->is_contested = gateway && gateway->is_connected;
  return line;
}

Result<storage::Run> MachineRouter::start(const machines::StartRequest& request) {
  if (!lines_.machine(request.machine)) {
    if (request.head == machines::StartHead::Ask) return gateways_.start(request);
    return fail(Errc::Unsupported,
                "machine '{}' has a gateway, which looks through the program up to the beginning: "
                "head is for serial lines",
                request.machine);
  }
  if (const auto view = machine(request.machine); view && view->is_contested) {
    return fail(Errc::Busy,
                "a gateway claims to be machine '{}', which has a port: stop the gateway or "
                "disable the port",
                request.machine);
  }
  return lines_.start(request);
}

Result<void> MachineRouter::command(const machines::CommandRequest& request) {
  if (request.run.empty()) {
    return lines_.machine(request.machine) ? lines_.command(request) : gateways_.command(request);
  }
  const auto run = runs_.find(request.run);
  if (!run) return fail(run.error());
  if (lines_.machine(run->machine)) return lines_.command(request);
  return gateways_.command(request);
}

}  // namespace dripline::ports
