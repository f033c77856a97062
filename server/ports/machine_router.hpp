#pragma once

#include "server/machines/machine_control.hpp"
#include "server/ports/line_machines.hpp"

namespace dripline::ports {

/// All machines of the server, however they are fed: those with an enabled port over their line,
/// all others by their gateway. A machine has one feeder: while a gateway speaks for one that has a
/// port, the machine is contested and nothing is started.
class MachineRouter final : public machines::MachineControl {
 public:
  MachineRouter(storage::RunStore& runs, machines::MachineControl& gateways, LineMachines& lines)
      : runs_(runs), gateways_(gateways), lines_(lines) {}

  /// In order of their names.
  std::vector<machines::MachineView> machines() const override;
  Result<machines::MachineView> machine(const std::string& name) const override;
  Result<storage::Run> start(const machines::StartRequest& request) override;
  Result<void> command(const machines::CommandRequest& request) override;

 private:
  storage::RunStore& runs_;
  machines::MachineControl& gateways_;
  LineMachines& lines_;
};

}  // namespace dripline::ports
