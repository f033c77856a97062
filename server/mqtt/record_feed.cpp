#include "server/mqtt/record_feed.hpp"

#include <algorithm>

namespace dripline::mqtt {
namespace {

/// Of one machine at a time, so that one with much to report delays no other.
constexpr std::size_t kPiece = 20;

}  // namespace

void RecordFeed::restart() {
  under_way_.clear();
  sent_.clear();
}

bool RecordFeed::wants(const storage::Record& record) const {
  return options_.kinds.empty() ||
         std::ranges::find(options_.kinds, record.kind) != options_.kinds.end();
}

void RecordFeed::add(Entry entry) {
  sent_[{entry.cursor.machine, entry.cursor.epoch}] = entry.cursor.number;
  under_way_.push_back(std::move(entry));
}

std::uint64_t RecordFeed::position(const storage::RecordCursor& read) const {
  std::uint64_t at = read.number;
  for (const auto* numbers : {&sent_, &passed_}) {
    const auto known = numbers->find({read.machine, read.epoch});
    if (known != numbers->end()) at = std::max(at, known->second);
  }
  return at;
}

/// True: the journal is at its end.
Result<bool> RecordFeed::fill_from(const storage::UnreadRecords& journal, const Publish& publish) {
  const auto& [machine, epoch, read] = journal.cursor;
  std::uint64_t at = position(journal.cursor);
  if (at >= journal.last) return true;
  const std::size_t room = std::min(kPiece, options_.window - under_way_.size());
  const auto records = store_.records.of_machine_after(machine, {epoch, at}, room);
  if (!records) return fail(records.error());
  for (const auto& record : *records) {
    Entry entry{.cursor = {machine, epoch, record.number}, .skipped = record.number - at - 1};
    if (wants(record)) {
      const auto message = publish(record);
      if (!message) return fail(message.error());
      entry.message = *message;
    }
    entry.is_done = entry.message == 0;
    add(std::move(entry));
    at = record.number;
  }
  if (records->empty()) {  // all of them are in an archive
    add({.cursor = {machine, epoch, journal.last}, .skipped = journal.last - at, .is_done = true});
    at = journal.last;
  }
  return at >= journal.last;
}

Result<bool> RecordFeed::fill(const Publish& publish) {
  if (under_way_.size() >= options_.window) return false;
  auto journals = store_.record_readers.unread(reader_);
  if (!journals) return fail(journals.error());
  const auto first = std::ranges::find_if(
      *journals, [&](const auto& journal) { return journal.cursor.machine > last_machine_; });
  std::rotate(journals->begin(), first, journals->end());
  bool is_more = false;
  std::string unfinished;  // a machine's next journal begins after the one before
  for (const auto& journal : *journals) {
    if (journal.cursor.machine == unfinished) continue;
    if (under_way_.size() >= options_.window) {
      is_more = true;
      break;
    }
    const auto at_end = fill_from(journal, publish);
    if (!at_end) return at_end;
    last_machine_ = journal.cursor.machine;
    if (*at_end) continue;
    unfinished = journal.cursor.machine;
    is_more = true;
  }
  pass();
  return is_more;
}

std::optional<storage::RecordCursor> RecordFeed::acknowledge(std::uint64_t message) {
  const auto entry = std::ranges::find_if(under_way_, [message](const Entry& candidate) {
    return !candidate.is_done && candidate.message == message;
  });
  if (entry == under_way_.end()) return std::nullopt;
  entry->is_done = true;
  auto cursor = entry->cursor;
  pass();
  return cursor;
}

void RecordFeed::pass() {
  while (!under_way_.empty() && under_way_.front().is_done) {
    const auto& [cursor, message, skipped, is_done] = under_way_.front();
    passed_[{cursor.machine, cursor.epoch}] = cursor.number;
    missing_ += skipped;
    under_way_.pop_front();
  }
}

Result<void> RecordFeed::commit() {
  if (passed_.empty()) return {};
  std::vector<storage::RecordCursor> cursors;
  cursors.reserve(passed_.size());
  for (const auto& [journal, number] : passed_)
    cursors.push_back({journal.first, journal.second, number});
  if (auto stored = store_.record_readers.advance(reader_, cursors); !stored) return stored;
  for (const auto& [journal, number] : passed_) {
    const auto sent = sent_.find(journal);
    if (sent != sent_.end() && sent->second <= number) sent_.erase(sent);
  }
  passed_.clear();
  return {};
}

}  // namespace dripline::mqtt
