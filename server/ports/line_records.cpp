#include "server/ports/line_records.hpp"

#include <spdlog/spdlog.h>
#include <algorithm>

namespace dripline::ports {

void LineRecords::add(std::vector<Entry> entries) {
  const UtcTime now = parts_.clock.now();
  for (auto& entry : entries) {
    entry.record.machine = parts_.machine;
    entry.record.epoch = parts_.epoch;
    entry.record.time = now;
    waiting_.push_back(std::move(entry));
  }
  if (pause_.count() == 0) commit();
}

/// A former line of this machine may have used numbers of this epoch.
Result<void> LineRecords::number_waiting() {
  if (!last_) {
    storage::RecordBatch nothing;
    nothing.machine = parts_.machine;
    nothing.epoch = parts_.epoch;
    const auto last = parts_.store.store(nothing);
    if (!last) return fail(last.error());
    last_ = *last;
  }
  for (; numbered_ < waiting_.size(); ++numbered_) waiting_[numbered_].record.number = ++*last_;
  return {};
}

void LineRecords::commit() {
  if (waiting_.empty()) return;
  if (auto numbered = number_waiting(); !numbered) return retry(numbered.error());
  storage::RecordBatch batch;
  batch.machine = parts_.machine;
  batch.epoch = parts_.epoch;
  for (const auto& entry : waiting_) {
    batch.records.push_back(entry.record);
    if (entry.beginning) batch.beginnings.push_back(*entry.beginning);
    if (entry.ending) batch.endings.push_back(*entry.ending);
  }
  const auto stored = parts_.store.store(batch);
  if (!stored) return retry(stored.error());
  if (pause_.count() > 0) {
    spdlog::info("records are stored again machine={}", parts_.machine);
    if (parts_.on_fault) parts_.on_fault("");
  }
  pause_ = {};
  std::deque<Entry> done = std::move(waiting_);
  waiting_.clear();
  numbered_ = 0;
  parts_.on_stored(batch);
  for (const auto& entry : done) {
    if (entry.on_stored) entry.on_stored();
  }
}

void LineRecords::retry(const Error& error) {
  if (pause_.count() == 0) {
    spdlog::error("records cannot be stored, the line is held machine={}: {}", parts_.machine,
                  error.what);
  }
  if (parts_.on_fault) parts_.on_fault(error.what);
  pause_ = std::clamp(pause_ * 2, kFirstPause, kLongestPause);
  parts_.strand.post_after(pause_, [self = shared_from_this()] { self->commit(); });
}

}  // namespace dripline::ports
