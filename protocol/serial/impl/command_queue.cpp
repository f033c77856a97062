#include "protocol/serial/impl/command_queue.hpp"

#include <sys/eventfd.h>

#include "protocol/base/invariant.hpp"

namespace dripline::serial {

CommandQueue::CommandQueue() : event_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  invariant(static_cast<bool>(event_), "an event descriptor can be had");
}

void CommandQueue::push(Work work) {
  {
    const std::lock_guard lock(mutex_);
    invariant(waiting_.size() < kMax, "a line is not given work without bound");
    waiting_.push_back(std::move(work));
  }
  wake();
}

void CommandQueue::wake() {
  (void)::eventfd_write(event_.get(), 1);
}

std::vector<CommandQueue::Work> CommandQueue::take() {
  eventfd_t count = 0;
  (void)::eventfd_read(event_.get(), &count);
  const std::lock_guard lock(mutex_);
  return std::exchange(waiting_, {});
}

}  // namespace dripline::serial
