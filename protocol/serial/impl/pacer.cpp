#include "protocol/serial/impl/pacer.hpp"

#include <algorithm>

namespace dripline::serial {

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
