#include "server/ports/line_records.hpp"

#include <algorithm>
#include <utility>

namespace dripline::ports {

LineRecords::LineRecords(Parts parts)
    : parts_(std::move(parts)),
      writer_({.store = parts_.store,
               .machine = parts_.machine,
               .consequence = "the line is held",
               .on_fault = parts_.on_fault}) {}

void LineRecords::add(std::vector<Entry> entries) {
  const UtcTime now = parts_.clock.now();
  for (auto& entry : entries) {
    entry.record.machine = parts_.machine;
    entry.record.epoch = parts_.epoch;
    entry.record.time = now;
    waiting_.push_back(std::move(entry));
  }
  if (writer_.pause().count() == 0) commit();
}

std::size_t LineRecords::drop() {
  // Their callbacks can hold this object.
  numbered_ = 0;
  return std::exchange(waiting_, {}).size();
}

/// A former line of this machine may have used numbers of this epoch.
Result<void> LineRecords::number_waiting() {
  if (!last_) {
    storage::RecordBatch nothing;
    nothing.machine = parts_.machine;
    nothing.epoch = parts_.epoch;
    const auto last = writer_.store(nothing);
    if (!last) return fail(last.error());
    last_ = *last;
  }
  for (; numbered_ < waiting_.size(); ++numbered_) waiting_[numbered_].record.number = ++*last_;
  return {};
}

void LineRecords::commit() {
  if (waiting_.empty()) return;
  if (!number_waiting()) return retry();
  storage::RecordBatch batch;
  batch.machine = parts_.machine;
  batch.epoch = parts_.epoch;
  for (const auto& entry : waiting_) {
    batch.records.push_back(entry.record);
    if (entry.beginning) batch.beginnings.push_back(*entry.beginning);
    if (entry.ending) batch.endings.push_back(*entry.ending);
  }
  const auto stored = writer_.store(batch);
  if (!stored) return retry();
  std::deque<Entry> done = std::move(waiting_);
  waiting_.clear();
  numbered_ = 0;
  parts_.on_stored(batch);
  for (const auto& entry : done) {
    if (entry.on_stored) entry.on_stored();
  }
}

void LineRecords::retry() {
  const auto pause = std::max(writer_.pause(), machines::RecordWriter::kFirstPause);
  parts_.strand.post_after(pause, [self = shared_from_this()] { self->commit(); });
}

}  // namespace dripline::ports
