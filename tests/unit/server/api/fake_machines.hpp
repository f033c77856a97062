#pragma once

#include <vector>

#include "server/machines/machine_control.hpp"

namespace dripline::server_test {

/// Machines that a test lists, and commands that are only noted.
class FakeMachines final : public machines::MachineControl {
 public:
  std::vector<machines::MachineView> machines() const override { return views; }
  Result<machines::MachineView> machine(const std::string& name) const override {
    for (const auto& view : views) {
      if (view.machine.name == name) return view;
    }
    return fail(Errc::NotFound, "machine '{}' is not known", name);
  }
  Result<storage::Run> start(const machines::StartRequest& request) override {
    started.push_back(request);
    if (refusal) return fail(*refusal);
    if (auto view = machine(request.machine); !view) return fail(view.error());
    return run;
  }
  Result<void> command(const machines::CommandRequest& request) override {
    commands.push_back(request);
    if (refusal) return fail(*refusal);
    return {};
  }

  std::vector<machines::MachineView> views;
  std::vector<machines::StartRequest> started;
  std::vector<machines::CommandRequest> commands;
  std::optional<Error> refusal;
  storage::Run run;
};

}  // namespace dripline::server_test
