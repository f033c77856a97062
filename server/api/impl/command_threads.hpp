#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>

namespace dripline::api {

/// A thread for each command that waits for a machine. Commands wait for seconds when a gateway
/// hangs, and a fixed number of threads would then delay the commands for all other machines, a
/// stop among them. Commands are rare, and a waiting thread costs almost nothing. Some are left for
/// stops when all others wait.
class CommandThreads {
 public:
  explicit CommandThreads(std::size_t limit) : limit_(limit) {}
  ~CommandThreads() { wait(); }
  CommandThreads(const CommandThreads&) = delete;
  CommandThreads& operator=(const CommandThreads&) = delete;

  /// False when `limit` commands are running, with stops kForStops more, or no thread can be
  /// created.
  bool run(std::function<void()> command, bool may_be_stop);
  static constexpr std::size_t kForStops = 64;
  /// Waits until no command is running.
  void wait();

 private:
  const std::size_t limit_;
  std::mutex mutex_;
  std::condition_variable ended_;
  std::size_t running_ = 0;
};

}  // namespace dripline::api
