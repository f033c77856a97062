#include "server/machines/worker_pool.hpp"

#include <utility>
#include "protocol/process/log.hpp"

namespace dripline::machines {

using SteadyClock = std::chrono::steady_clock;

WorkerPool::WorkerPool(unsigned threads) {
  for (unsigned i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
}

WorkerPool::~WorkerPool() {
  stop();
}

void WorkerPool::post(Task task) {
  {
    const std::lock_guard lock(mutex_);
    if (is_stopping_) return;
    ready_.push_back(std::move(task));
  }
  changed_.notify_one();
}

void WorkerPool::post_after(std::chrono::milliseconds delay, Task task) {
  {
    const std::lock_guard lock(mutex_);
    if (is_stopping_) return;
    delayed_.emplace(SteadyClock::now() + delay, std::move(task));
  }
  changed_.notify_one();
}

void WorkerPool::stop() {
  {
    const std::lock_guard lock(mutex_);
    is_stopping_ = true;
    delayed_.clear();
  }
  changed_.notify_all();
  for (auto& thread : threads_) {
    if (thread.joinable()) thread.join();
  }
}

void WorkerPool::work() {
  for (Task task; take(task); task = nullptr) {
    try {
      task();
    } catch (const std::exception& e) {  // memory is exhausted, or a bug
      process::log_error("task failed, tried again: {}", e.what());
      post_after(kRetry, std::move(task));
    }
  }
}

bool WorkerPool::take(Task& task) {
  std::unique_lock lock(mutex_);
  for (;;) {
    const auto now = SteadyClock::now();
    while (!delayed_.empty() && delayed_.begin()->first <= now) {
      ready_.push_back(std::move(delayed_.begin()->second));
      delayed_.erase(delayed_.begin());
    }
    if (!ready_.empty()) {
      task = std::move(ready_.front());
      ready_.pop_front();
      if (!ready_.empty()) changed_.notify_one();
      return true;
    }
    if (is_stopping_) return false;
    if (delayed_.empty()) {
      changed_.wait(lock);
    } else {
      // A copy: the entry may be gone before the wait ends.
      const auto when = delayed_.begin()->first;
      changed_.wait_until(lock, when);
    }
  }
}

}  // namespace dripline::machines
