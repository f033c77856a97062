#include <map>
#include <utility>

#include "server/ports/gateways/gateway_view.hpp"
#include "server/ports/line_machines.hpp"

namespace dripline::ports {

MachineRouter::Views MachineRouter::machines() const {
  return merged(gateways_.machines(), lines_.machines());
}

/// The first ones of both are among the first ones of each.
MachineRouter::Views MachineRouter::machines_after(const machines::MachinePage& page) const {
  Views views = merged(gateways_.machines_after(page), lines_.machines_after(page));
  if (views.size() > page.limit) views.resize(page.limit);
  return views;
}

MachineRouter::Views MachineRouter::merged(Views gateways, Views lines) {
  std::map<std::string, machines::MachineView> views;
  for (auto& view : gateways) {
    const std::string name = view.machine.name;
    views.emplace(name, std::move(view));
  }
  for (auto& view : lines) {
    const std::string name = view.machine.name;
    const auto gateway = views.find(name);
    view.is_contested = gateway != views.end() && gateway->second.is_connected;
    views.insert_or_assign(name, std::move(view));
  }
  Views ordered;
  ordered.reserve(views.size());
  for (auto& [name, view] : views) ordered.push_back(std::move(view));
  return ordered;
}

Result<void> MachineRouter::remove(const std::string& machine, const storage::Actor& who) {
  if (lines_.machine(machine))
    return fail(Errc::Conflict, "machine '{}' has a port: remove that first", machine);
  return gateways_.remove(machine, who);
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
    const auto gateway = gateways_.machine(request.machine);
    const bool has_line = gateway && gateway->has_gateway_line();
    if (has_line) {
      const PortView port = view_of(*gateway, *gateway->status->serial_line);
      if (auto ready = lines_.resets().check(port, ""); !ready) return fail(ready.error());
    }
    if (request.head == machines::StartHead::Ask || has_line) return gateways_.start(request);
    return fail(Errc::Unsupported,
                "machine '{}' has a gateway, which looks through the program up to the beginning: "
                "head is for serial lines",
                request.machine);
  }
  if (request.is_mdi) {
    return fail(Errc::Unsupported, "machine '{}' is at the end of a line: MDI is its control's own",
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

Result<machines::PositionAnswer> MachineRouter::position(const machines::PositionRequest& request) {
  return lines_.machine(request.machine) ? lines_.position(request) : gateways_.position(request);
}

Result<machines::JogAnswer> MachineRouter::jog(const machines::JogRequest& request) {
  return lines_.machine(request.machine) ? lines_.jog(request) : gateways_.jog(request);
}

Result<std::string> MachineRouter::values(const machines::ValueQuery& query) {
  return lines_.machine(query.machine) ? lines_.values(query) : gateways_.values(query);
}

std::optional<std::string> MachineRouter::machine_of_run(const std::string& run) const {
  auto machine = gateways_.machine_of_run(run);
  return machine ? machine : lines_.machine_of_run(run);
}

Result<void> MachineRouter::command(const machines::CommandRequest& request) {
  if (request.run.empty()) {
    return lines_.has(request.machine) ? lines_.command(request) : gateways_.command(request);
  }
  // What a machine reports needs no store: a stop reaches it while there is none.
  auto machine = machine_of_run(request.run);
  if (!machine) {
    const auto run = runs_.find(request.run);
    if (!run) return fail(run.error());
    machine = run->machine;
  }
  return lines_.has(*machine) ? lines_.command(request) : gateways_.command(request);
}

}  // namespace dripline::ports
