#include "protocol/serial/impl/command_queue.hpp"

#include <algorithm>

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

std::size_t Pacer::computed(wire::LineTime now) const {
  if (empty_at_ <= now) return 0;
  return static_cast<std::size_t>((empty_at_ - now + time_ - wire::LineTime(1)) / time_);
}

std::size_t Pacer::allowance(wire::LineTime now, std::optional<std::size_t> unsent) const {
  const std::size_t held = std::max(computed(now), unsent.value_or(0));
  return held >= kWindow ? 0 : kWindow - held;
}

void Pacer::handed_over(std::size_t count, wire::LineTime now) {
  empty_at_ = std::max(empty_at_, now) + time_ * static_cast<long>(count);
}

wire::LineTime Pacer::next(wire::LineTime now, std::optional<std::size_t> unsent) const {
  const std::size_t held = computed(now);
  // The driver is late: check again when a character should have left.
  if (unsent && *unsent >= kWindow && *unsent > held) return now + time_;
  if (held < kWindow) return now;
  return empty_at_ - time_ * static_cast<long>(held - 1);
}

}  // namespace dripline::serial
