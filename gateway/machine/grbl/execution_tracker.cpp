#include "gateway/machine/grbl/execution_tracker.hpp"

#include <algorithm>

namespace dripline::machine::grbl {

std::uint64_t ExecutionTracker::sent(bool moves) {
  moves_.push_back(moves);
  rests_ = 0;
  return ++sent_;
}

void ExecutionTracker::answered() {
  if (answered_ < sent_) ++answered_;
  rests_ = 0;
}

void ExecutionTracker::execute_to(std::uint64_t serial) {
  for (; executed_ < serial && !moves_.empty(); ++executed_) moves_.pop_front();
}

/// Everything before the line of this number. Several lines in flight never have the same number.
std::uint64_t ExecutionTracker::shown_by_line(std::uint32_t number, bool& is_known) const {
  is_known = true;
  for (std::uint64_t serial = executed_ + 1; serial <= sent_; ++serial)
    if (number_of(serial) == number) return serial - 1;
  is_known = number >= 1 && number <= std::min<std::uint64_t>(sent_, numbers_);
  return executed_;
}

/// The blocks that the planner still has belong to the last lines that move, and a line has one
/// block at least.
std::uint64_t ExecutionTracker::shown_by_buffers(int free_blocks) const {
  const int used = *capacity_ - free_blocks;
  if (used < 0) return executed_;
  std::int64_t movable = 0;
  for (std::uint64_t i = 0; i < answered_ - executed_; ++i) movable += moves_[i] ? 1 : 0;
  std::int64_t done = movable - used;
  std::uint64_t serial = executed_;
  for (std::uint64_t i = 0; done > 0 && i < answered_ - executed_; ++i) {
    if (moves_[i]) --done;
    serial = executed_ + i + 1;
  }
  return serial;
}

/// A report can be made between a line's `ok` and the start of its motion. Without buffers in the
/// report, only several at rest in a row are believed: Grbl names a planned block then, grblHAL the
/// line that it has parsed last, executed or not.
void ExecutionTracker::on_rest(const StatusReport& report) {
  shown_.clear();
  const bool has_buffers = report.buffers && capacity_;
  const bool is_planned = has_buffers && report.buffers->free_blocks < *capacity_;
  if (answered_ < sent_ || is_planned) {
    rests_ = 0;
    return;
  }
  int needed = 2;
  if (has_buffers || (has_seen_number_ && !report.line)) needed = 1;
  if (!has_buffers && report.line) needed = 3;
  if (++rests_ >= needed) execute_to(sent_);
}

bool ExecutionTracker::reported(const StatusReport& report, SteadyTime now) {
  bool is_known = true;
  const std::uint64_t by_line = report.line ? shown_by_line(*report.line, is_known) : executed_;
  // A line has been answered when the next one is planned.
  if (!is_known || by_line > answered_) return false;
  if (report.line) has_seen_number_ = true;
  if (report.state == BoardState::Idle) {
    on_rest(report);
    return true;
  }
  rests_ = 0;
  if (report.state != BoardState::Run) {
    shown_.clear();
    return true;
  }
  for (; !shown_.empty() && now - shown_.front().at >= kAhead; shown_.pop_front())
    execute_to(shown_.front().serial);
  if (report.line)
    shown_.push_back({by_line, now});
  else if (!has_seen_number_ && report.buffers && capacity_)
    shown_.push_back({shown_by_buffers(report.buffers->free_blocks), now});
  return true;
}

void ExecutionTracker::drop() {
  sent_ = answered_ = executed_;
  moves_.clear();
  shown_.clear();
  rests_ = 0;
}

}  // namespace dripline::machine::grbl
