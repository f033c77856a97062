#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>

namespace dripline::api {

/// A thread for each command that waits for a machine: they wait for seconds when a gateway hangs,
/// and a fixed number of threads would then keep the commands to all other machines, a stop among
/// them, from being sent. Commands are rare, and a thread that waits costs next to nothing.
class CommandThreads {
 public:
  explicit CommandThreads(std::size_t limit) : limit_(limit) {}
  ~CommandThreads() { wait(); }
  CommandThreads(const CommandThreads&) = delete;
  CommandThreads& operator=(const CommandThreads&) = delete;

  /// False when `limit` are under way, or no thread can be made.
  bool run(std::function<void()> command);
  /// Until none is under way.
  void wait();

 private:
  const std::size_t limit_;
  std::mutex mutex_;
  std::condition_variable ended_;
  std::size_t running_ = 0;
};

}  // namespace dripline::api
