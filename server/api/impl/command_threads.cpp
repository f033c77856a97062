#include "server/api/impl/command_threads.hpp"

#include <system_error>
#include <thread>
#include <utility>

namespace dripline::api {

bool CommandThreads::run(std::function<void()> command, bool may_be_stop) {
  {
    const std::lock_guard lock(mutex_);
    if (running_ >= limit_ + (may_be_stop ? kForStops : 0)) return false;
    ++running_;
  }
  const auto end = [this] {
    const std::lock_guard lock(mutex_);
    --running_;
    ended_.notify_all();  // under the lock: a waiting thread may destroy this object
  };
  try {
    std::thread([end, command = std::move(command)]() mutable {
      command();
      command = nullptr;  // releases its captures before a waiting thread continues
      end();
    }).detach();
    return true;
  } catch (const std::system_error&) {
    end();
    return false;
  }
}

void CommandThreads::wait() {
  std::unique_lock lock(mutex_);
  ended_.wait(lock, [this] { return running_ == 0; });
}

}  // namespace dripline::api
