#include "gateway/app/serial/task_queue.hpp"

#include <utility>

namespace dripline::gateway {

void TaskQueue::post(Task task) {
  {
    const std::lock_guard lock(mutex_);
    if (is_closed_) return;
    waiting_.push_back(std::move(task));
  }
  if (wake_) wake_();
}

void TaskQueue::run() {
  for (;;) {
    std::deque<Task> tasks;
    {
      const std::lock_guard lock(mutex_);
      tasks.swap(waiting_);
    }
    if (tasks.empty()) return;
    for (Task& task : tasks) task();
  }
}

void TaskQueue::close() {
  const std::lock_guard lock(mutex_);
  is_closed_ = true;
  waiting_.clear();
}

}  // namespace dripline::gateway
