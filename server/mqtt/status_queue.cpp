#include "server/mqtt/status_queue.hpp"

#include <algorithm>
#include <utility>

namespace dripline::mqtt {

SteadyTime StatusQueue::due(const Entry& entry) const {
  return entry.taken ? *entry.taken + interval_ : SteadyTime::min();
}

bool StatusQueue::note(const machines::MachineView& view) {
  const std::lock_guard lock(mutex_);
  auto& entry = entries_[view.machine.name];
  const bool was_empty = !entry.view;
  entry.view = view;
  return was_empty;
}

void StatusQueue::add(const machines::MachineView& view) {
  const std::lock_guard lock(mutex_);
  auto& entry = entries_[view.machine.name];
  if (!entry.view) entry.view = view;
}

std::optional<machines::MachineView> StatusQueue::take(SteadyTime now) {
  const std::lock_guard lock(mutex_);
  auto at = entries_.upper_bound(last_);
  for (std::size_t looked = 0; looked < entries_.size(); ++looked, ++at) {
    if (at == entries_.end()) at = entries_.begin();
    auto& entry = at->second;
    if (!entry.view || due(entry) > now) continue;
    auto taken = std::exchange(entry.view, std::nullopt);
    entry.taken = now;
    last_ = at->first;
    return taken;
  }
  return std::nullopt;
}

std::optional<SteadyTime> StatusQueue::next_due() const {
  const std::lock_guard lock(mutex_);
  std::optional<SteadyTime> next;
  for (const auto& [machine, entry] : entries_) {
    if (entry.view) next = std::min(next.value_or(SteadyTime::max()), due(entry));
  }
  return next;
}

}  // namespace dripline::mqtt
