#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

namespace dripline::machines {

/// A fixed number of threads for work that may wait for storage or for a gateway. Tasks begin in
/// the order they were posted, delayed ones when their time has come. The caller keeps the
/// number of its own waiting tasks bounded. A task that throws is tried again after kRetry: it must
/// neither end the server nor stop what it serves forever.
class WorkerPool {
 public:
  using Task = std::function<void()>;
  static constexpr std::chrono::milliseconds kRetry{500};
  explicit WorkerPool(unsigned threads);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// Both from any thread; ignored after stop().
  void post(Task task);
  void post_after(std::chrono::milliseconds delay, Task task);
  /// Runs what is waiting, drops what is delayed, and ends the threads. Not from a task.
  void stop();

 private:
  void work();
  bool take(Task& task);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Task> ready_;
  std::multimap<std::chrono::steady_clock::time_point, Task> delayed_;
  bool is_stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace dripline::machines
