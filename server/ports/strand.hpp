#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <mutex>

#include "server/machines/worker_pool.hpp"

namespace dripline::ports {

/// Work of one port, one task after the other in the order of posting, on a pool of threads. Any
/// thread. The caller keeps the number of its waiting tasks bounded; a task keeps alive what it
/// needs. The pool must outlive the strand; what is posted when the pool has stopped is dropped.
class Strand {
 public:
  using Task = std::function<void()>;
  explicit Strand(machines::WorkerPool& pool) : lane_(std::make_shared<Lane>(pool)) {}

  void post(Task task) const;
  void post_after(std::chrono::milliseconds delay, Task task) const;

 private:
  struct Lane {
    explicit Lane(machines::WorkerPool& shared) : pool(shared) {}
    machines::WorkerPool& pool;
    std::mutex mutex;
    std::deque<Task> waiting;
    bool is_scheduled = false;
  };
  static void enter(const std::shared_ptr<Lane>& lane, Task task);
  static void run_one(const std::shared_ptr<Lane>& lane);

  std::shared_ptr<Lane> lane_;  ///< running tasks share it
};

/// Of a line: what waits for the store, and what never does.
struct Strands {
  Strand store, near;
};

}  // namespace dripline::ports
