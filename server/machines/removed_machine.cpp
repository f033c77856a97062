// A machine that is no more there: its entry stays, for its gateway may announce itself again.
#include "protocol/process/log.hpp"
#include "server/machines/machine_registry.hpp"

namespace dripline::machines {

Result<void> MachineRegistry::check_removable(const Entry& entry) {
  const std::string& name = entry.view.machine.name;
  if (entry.view.is_connected || entry.view.unconfirmed_gateway)
    return fail(Errc::Busy, "machine '{}' is connected: stop its gateway first", name);
  const bool is_busy = entry.is_saving || entry.is_scheduled || entry.is_telling;
  if (is_busy || entry.machine_is_dirty)
    return fail(Errc::Busy, "machine '{}' is just being stored: again in some seconds", name);
  return {};
}

/// Taken out first: what its gateway announces meanwhile is stored after it.
Result<void> MachineRegistry::remove(const std::string& name, const storage::Actor& who) {
  Entry* entry = nullptr;
  {
    const std::lock_guard lock(mutex_);
    const auto found = entries_.find(name);
    if (found == entries_.end() || !is_shown(found->second))
      return fail(Errc::NotFound, "machine '{}' is not known", name);
    entry = &found->second;
    if (auto may = check_removable(*entry); !may) return may;
    entry->is_removed = true;
  }
  auto removed = parts_.machines.remove(name, who, parts_.clock.now());
  const std::lock_guard lock(mutex_);
  if (!removed) {
    entry->is_removed = false;
    return removed;
  }
  process::log_info("machine removed machine={} by={}", name, who.name);
  if (!entry->is_removed) {  // it announced itself: its next save takes the removal back
    entry->machine_is_dirty = true;
    schedule(*entry);
    return {};
  }
  entry->is_stored = false;
  entry->view.status = {};
  entry->view.status_taken.reset();
  entry->view.lost_switches.clear();
  entry->counters_are_dirty = false;
  return {};
}

}  // namespace dripline::machines
