#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "server/machines/command_dispatcher.hpp"
#include "server/machines/gateway_clocks.hpp"
#include "server/machines/machine_control.hpp"
#include "server/machines/worker_pool.hpp"

namespace dripline::machines {

/// What is known of every machine now. Status lives in memory only; its counters go to the run at
/// most every kSaveInterval. A machine is added when it announces itself for the first time.
class MachineRegistry {
 public:
  static constexpr std::chrono::seconds kSaveInterval{2};
  /// A machine stays contested this long after the last status of a second gateway; each writes one
  /// a second.
  static constexpr std::chrono::seconds kContested{3};

  struct Parts {
    storage::MachineStore& machines;
    storage::RunStore& runs;
    const Clock& clock;
    WorkerPool& pool;
    std::function<void(const MachineView&)> on_change;  ///< on a worker, latest state only
  };
  explicit MachineRegistry(Parts parts) : parts_(std::move(parts)) {}

  /// Reads the stored machines; called first.
  Result<void> load();

  /// These come from DDS threads and return at once.
  void on_announce(const dds::Announce& announce);
  void on_status(dds::Status status);
  void on_lost(const std::string& machine);
  /// Another gateway of the same name waits for the present one to leave, or waits no longer.
  void on_rival(const std::string& machine, bool is_there);

  std::vector<MachineView> views() const;
  Result<MachineView> view(const std::string& name) const;
  /// The present gateway of the machine, and its steady clock.
  CommandDispatcher::Options::Gateway gateway(const std::string& name) const;
  /// How far the gateway's time of day is ahead of the server's; zero while that is within the
  /// tolerance.
  std::chrono::microseconds clock_error(const std::string& name) const;
  /// Saves what changed: counters of runs, and when a machine was seen last. From a worker.
  void save();

 private:
  struct Entry {
    MachineView view;
    std::deque<std::uint64_t> earlier_sessions;  ///< of gateways before, the newest kMaxSessions
    SteadyTime contested_until{};
    bool has_rival = false;
    GatewayClocks clocks;
    bool clock_is_off = false;  ///< and the log has it
    bool is_scheduled = false;  ///< a change is about to be published
    bool is_telling = false;
    bool machine_is_dirty = false;  ///< the stored part changed
    bool counters_are_dirty = false;
  };
  void hear(Entry& entry, std::uint64_t session);
  void contest(Entry& entry);
  void compare_clocks(Entry& entry, const dds::Status& status);
  MachineView shown(const Entry& entry) const;
  void publish(const std::string& name);
  void schedule(Entry& entry);
  void save_machine(const std::string& name);

  Parts parts_;
  mutable std::mutex mutex_;
  std::map<std::string, Entry> entries_;
};

}  // namespace dripline::machines
