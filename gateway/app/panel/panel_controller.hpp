#pragma once

#include <optional>
#include <string>

#include "gateway/app/command_log.hpp"
#include "gateway/app/panel/consent.hpp"
#include "gateway/app/panel/kept_emergency_stop.hpp"
#include "gateway/app/run/run_session.hpp"
#include "gateway/interpreter/core/dialect.hpp"

namespace dripline::gateway {

/// The operator's panel: switches, overrides, the handwheel, the emergency stop and the remote
/// enable, whether they are set over the network or at the machine. One thread.
class PanelController {
 public:
  struct Parts {
    const interpreter::Dialect& dialect;
    machine::MotionBackend& machine;
    ExecutionRecorder& recorder;
    CurrentRun& run;
    Consent& consent;
    KeptEmergencyStop& emergency_stop;
  };
  /// All references must outlive it.
  explicit PanelController(const Parts& parts) : parts_(parts) {}

  /// The switches as the gateway's setup has them, before the first run; the emergency stop as the
  /// process before this one has left it.
  void begin(const interpreter::Setup& setup);
  /// Positions of the control's switches, as the setup describes them.
  void take_tables(const interpreter::Setup& setup);
  /// For the status.
  dds::PanelSwitches switches() const;

  Reply set_switch(const dds::Command& command);
  Reply set_override(const dds::Command& command);
  Reply turn_handwheel(const dds::Command& command);

  /// Every machine has one, whatever its control. One that was pressed at the machine is released
  /// there only. The axes brake at once; on disk before the answer, or the answer says that not.
  Reply set_emergency_stop(bool is_pressed, bool is_at_panel);
  /// Moves nothing by itself: a run that waits continues to wait for a cycle start, at the machine
  /// or, now, over the network.
  Reply set_remote_enable(bool is_enabled);
  /// Why a command from the network is refused for now.
  std::optional<Reply> refusal_without_consent(const dds::Command& command) const;

 private:
  void switch_emergency_stop(bool is_pressed);
  Reply set_block_skip(int level, bool is_on);
  Reply set_dry_run(bool is_on);
  Reply set_machine_lock(bool is_on);
  Reply set_between_runs(const char* what, bool machine::OperatorPanel::*which, bool is_on);
  Reply note(const std::string& name, bool is_on, const std::string& effect);
  std::uint16_t skip_levels() const;
  std::string known_switches() const;
  std::optional<std::string> refusal_of_feed(double factor) const;
  std::optional<std::string> refusal_of_spindle(double factor) const;

  Parts parts_;
  interpreter::PanelTables tables_;
};

inline constexpr std::string_view kDoorWasOpen =
    "the safety door was opened: only cycle start at the machine's panel moves the axes again";
inline constexpr std::string_view kEmergencyStopIsPressed =
    "the emergency stop is pressed: release it first";

}  // namespace dripline::gateway
