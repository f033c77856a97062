#include "server/ports/strand.hpp"

#include <utility>

namespace dripline::ports {

void Strand::post(Task task) const {
  enter(lane_, std::move(task));
}

void Strand::post_after(std::chrono::milliseconds delay, Task task) const {
  lane_->pool.post_after(delay, [lane = lane_, task = std::move(task)] { enter(lane, task); });
}

void Strand::enter(const std::shared_ptr<Lane>& lane, Task task) {
  {
    const std::lock_guard lock(lane->mutex);
    lane->waiting.push_back(std::move(task));
    if (std::exchange(lane->is_scheduled, true)) return;
  }
  lane->pool.post([lane] { run_one(lane); });
}

/// One task, then back into the pool's queue: no port keeps a thread for itself.
void Strand::run_one(const std::shared_ptr<Lane>& lane) {
  Task task;
  {
    const std::lock_guard lock(lane->mutex);
    task = std::move(lane->waiting.front());
    lane->waiting.pop_front();
  }
  try {
    task();
  } catch (...) {  // the pool tries again
    const std::lock_guard lock(lane->mutex);
    lane->waiting.push_front(std::move(task));
    throw;
  }
  const std::lock_guard lock(lane->mutex);
  lane->is_scheduled = !lane->waiting.empty();
  if (lane->is_scheduled) lane->pool.post([lane] { run_one(lane); });
}

}  // namespace dripline::ports
