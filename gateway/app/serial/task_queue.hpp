#pragma once

#include <deque>
#include <functional>
#include <mutex>

namespace dripline::gateway {

/// Tasks of other threads for the gateway's own, in the order of posting. The caller keeps their
/// number bounded; what is posted after `close` is dropped.
class TaskQueue {
 public:
  using Task = std::function<void()>;
  /// `wake`: a task waits; called on the posting thread.
  explicit TaskQueue(std::function<void()> wake) : wake_(std::move(wake)) {}

  void post(Task task);
  /// On the gateway's thread: runs what was posted, also by the tasks themselves.
  void run();
  void close();

 private:
  const std::function<void()> wake_;
  std::mutex mutex_;
  std::deque<Task> waiting_;
  bool is_closed_ = false;
};

}  // namespace dripline::gateway
