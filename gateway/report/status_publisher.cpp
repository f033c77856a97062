#include "gateway/report/status_publisher.hpp"

#include <tuple>

namespace dripline::report {
namespace {

/// Compares everything but the machine's name and the time.
auto content(const dds::Status& s) {
  return std::tie(s.execution, s.mode, s.run, s.program, s.sent, s.accepted, s.executed,
                  s.total_bytes, s.offset, s.line, s.sequence, s.position, s.feed_mm_per_min,
                  s.spindle_rpm, s.feed_override, s.rapid_override, s.spindle_override,
                  s.buffered_seconds, s.single_block, s.message, s.outbox, s.modes, s.coordinates,
                  s.emergency_stop, s.remote_enable, s.waits_for, s.screen);
}

}  // namespace

void StatusPublisher::offer(const dds::Status& status, SteadyTime now) {
  if (last_ && now < next_) return;
  const bool has_changed = !last_ || content(*last_) != content(status);
  if (!has_changed && now - sent_ < kMaxInterval) return;
  next_ = now + kMinInterval;
  if (!send_(status)) return;
  last_ = status;
  sent_ = now;
}

}  // namespace dripline::report
