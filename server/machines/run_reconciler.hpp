#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "protocol/base/clock.hpp"
#include "server/machines/command_dispatcher.hpp"
#include "server/machines/machine_control.hpp"

namespace dripline::machines {

/// Reconciles the stored state of unfinished runs with what the machines show, after a restart of
/// the server, a lost command result or a gateway that lost its memory:
/// a run that a machine shows is active; one that a connected machine with an empty outbox does not
/// show for kAbsence was never begun (Ordered: Refused) or was cut off without a record of it
/// (Active: Interrupted). A refused run that a machine shows all the same is unwanted. Everything
/// else is left to the gateway's own records.
class RunReconciler {
 public:
  static constexpr std::chrono::seconds kAbsence{15};

  struct Parts {
    storage::RunStore& runs;
    const Clock& clock;
    const CommandDispatcher& commands;
    std::mutex& state_mutex;
    std::function<void(const storage::Run&)> on_change;
    /// A machine shows a run whose start was reported as refused; at every comparison.
    std::function<void(const storage::Run&)> on_unwanted;
  };
  explicit RunReconciler(Parts parts) : parts_(std::move(parts)) {}

  /// Finds the unfinished runs of the server before this start.
  Result<void> load();
  void watch(const std::string& machine, const std::string& run);
  void drop(const std::string& run);
  /// Whether a run of this machine is watched.
  bool has_run(const std::string& machine) const;
  /// Compares; regularly, from one thread.
  void compare(const std::vector<MachineView>& machines);

  /// Ordered becomes `state`, every other state stays: its record arrived first. Returns the run.
  Result<storage::Run> resolve_ordered(const std::string& run, storage::RunState state,
                                       const std::string& reason);

 private:
  struct Watched {
    std::string machine;
    std::optional<SteadyTime> absent_since;
  };
  void judge(const std::string& run, const MachineView& view);
  void look_for_unwanted(const MachineView& view);
  bool is_absent_for_long(const std::string& run, bool is_absent);
  void give_up(const std::string& run);

  Parts parts_;
  mutable std::mutex mutex_;
  std::map<std::string, Watched> runs_;
};

}  // namespace dripline::machines
