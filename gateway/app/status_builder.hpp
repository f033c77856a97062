#pragma once

#include <string>

#include "gateway/app/panel/consent.hpp"
#include "gateway/app/run/run_session.hpp"

namespace dripline::gateway {

/// What the status reports of the links of a gateway.
struct LinkState {
  bool has_line = false;
  bool is_connected = false;      ///< to the server
  std::string line_fault;         ///< empty: none
  std::string refused_by_server;  ///< why it does not command this gateway
};

/// Makes the status message of a machine from the parts that know it. One thread.
class StatusBuilder {
 public:
  struct Parts {
    std::uint64_t gateway_session = 0;
    const interpreter::Dialect& dialect;
    const interpreter::Setup& setup;  ///< of the gateway, whose settings are in force at first
    const Clock& clock;
    const machine::MotionBackend& machine;
    const report::Outbox& outbox;
    const ExecutionRecorder& recorder;
    const Consent& consent;
    const CurrentRun& run;
  };
  /// All references must outlive it.
  explicit StatusBuilder(const Parts& parts) : parts_(parts) { take_settings(parts.setup); }

  /// Those of the control's screen are in force from here on.
  void take_settings(const interpreter::Setup& setup);

  dds::Status build(const LinkState& links) const;

 private:
  dds::ActiveModes modes(const machine::MachineStatus& now) const;
  dds::Screen screen(const machine::MachineStatus& now) const;
  dds::Coordinates coordinates(const machine::MachineStatus& now) const;
  void fill_machine(dds::Status& status, const machine::MachineStatus& now) const;
  void fill_run(dds::Status& status, const machine::MachineStatus& now) const;
  void fill_execution(dds::Status& status, const LinkState& links) const;
  dds::Execution execution_of_run(std::string& message, const LinkState& links) const;
  dds::WaitsFor waits_for(dds::Execution execution) const;
  dds::RemoteEnable remote_enable() const;

  Parts parts_;
  interpreter::ScreenSettings settings_;
};

/// The answer to `status` at the machine's panel, one line.
std::string panel_status(const dds::Status& status);

}  // namespace dripline::gateway
