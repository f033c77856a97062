#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "protocol/base/clock.hpp"
#include "server/machines/machine_control.hpp"

namespace dripline::mqtt {

/// The latest state of each machine until it is published, at most one in each interval. Its size
/// is that of the machines, whatever the outage. Any thread.
class StatusQueue {
 public:
  explicit StatusQueue(std::chrono::milliseconds interval) : interval_(interval) {}

  /// Replaces what waits. True: nothing of the machine waited.
  bool note(const machines::MachineView& view);
  /// The same of a state that may be older than what waits, which then stays.
  void add(const machines::MachineView& view);
  /// The next that is due, which then waits no longer.
  std::optional<machines::MachineView> take(SteadyTime now);
  /// When the next is due; nullopt: none waits.
  std::optional<SteadyTime> next_due() const;

 private:
  struct Entry {
    std::optional<machines::MachineView> view;
    std::optional<SteadyTime> taken;
  };
  SteadyTime due(const Entry& entry) const;

  const std::chrono::milliseconds interval_;
  mutable std::mutex mutex_;
  std::map<std::string, Entry> entries_;
  std::string last_;  ///< the machine taken last: the others come first
};

}  // namespace dripline::mqtt
