#pragma once

#include <map>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "server/library/health.hpp"
#include "server/machines/machine_control.hpp"
#include "storage/run_store.hpp"

namespace dripline::app {

/// Reports each machine that is not connected in the middle of a run: its gateway has some seconds
/// of program text, and this server may be the one that is cut off from it. One thread.
class LostMachines {
 public:
  /// A gateway that is restarted, or changes to another server, is connected again by then.
  static constexpr std::chrono::seconds kGrace{5};

  LostMachines(library::Health& health, const Clock& clock) : health_(health), clock_(clock) {}

  /// Whether there is a machine of which `look` needs to know whether it has a run.
  static bool is_any_away(const std::vector<machines::MachineView>& machines);
  /// `active`: the runs in progress.
  void look(const std::vector<machines::MachineView>& machines,
            const std::vector<storage::Run>& active);

 private:
  struct Away {
    SteadyTime since;
    bool is_reported = false;
  };
  void report(const storage::Run& run, Away& away);
  void clear(const std::string& machine, const Away& away);

  library::Health& health_;
  const Clock& clock_;
  std::map<std::string, Away> away_;  ///< machines with a run
};

}  // namespace dripline::app
