#include "server/library/history/retention.hpp"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "protocol/archive/archive_reader.hpp"
#include "protocol/archive/archive_writer.hpp"
#include "protocol/measurement/measurement_json.hpp"
#include "protocol/process/log.hpp"

namespace dripline::library {
namespace {

using nlohmann::json;
using storage::Archive;
using storage::ArchiveKind;

constexpr const char* kWho = "retention";  ///< in the audit trail

std::string one_line(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string record_line(const storage::Record& record) {
  return one_line(
      {{"machine", record.machine},
       {"epoch", record.epoch},
       {"number", record.number},
       {"time", to_iso8601(record.time)},
       {"run", record.run.empty() ? json(nullptr) : json(record.run)},
       {"kind", record.kind},
       {"block", record.block},
       {"line", record.line},
       {"sequence", record.sequence < 0 ? json(nullptr) : json(record.sequence)},
       {"device", record.device},
       {"text", record.text},
       {"received", record.received ? json(to_iso8601(*record.received)) : json(nullptr)}});
}

json part_json(const storage::MeasuredPart& part) {
  return {{"id", part.id},
          {"machine", part.machine},
          {"run", part.run},
          {"program", part.program},
          {"revision", part.revision},
          {"template", part.template_name},
          {"template_version", part.template_version},
          {"part_number", part.number},
          {"serial", part.serial},
          {"measurements", part.measurements},
          {"findings", part.findings},
          {"verdict", measurement::to_string(part.verdict)},
          {"begun", to_iso8601(part.begun)},
          {"ended", part.ended ? json(to_iso8601(*part.ended)) : json(nullptr)},
          {"superseded", part.is_superseded}};
}

json finding_json(const storage::ReportFinding& finding) {
  return {{"part", finding.part_id},
          {"epoch", finding.record.epoch},
          {"number", finding.record.number},
          {"time", to_iso8601(finding.time)},
          {"kind", finding.kind},
          {"text", finding.text}};
}

}  // namespace

Retention::~Retention() {
  end();
}

void Retention::begin() {
  worker_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

void Retention::end() {
  worker_.request_stop();
  if (worker_.joinable()) worker_.join();
}

void Retention::work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    if (const auto made = apply(stop); !made)
      process::log_error("retention: {}", made.error().what);
    check_archives(stop);
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, stop, options_.every, [&stop] { return stop.stop_requested(); });
  }
}

void Retention::check_archives(const std::stop_token& stop) {
  constexpr std::chrono::hours kEvery{24};
  const auto last = check_.state();
  if (last && parts_.clock.now() - last->at < kEvery) return;
  const auto checked = check_.check(stop);
  if (!checked && !stop.stop_requested())
    process::log_error("the check of the archives: {}", checked.error().what);
}

Result<Archive> Retention::find(std::uint64_t id) {
  constexpr std::uint64_t kPage = 1000;
  for (std::uint64_t offset = 0;; offset += kPage) {
    auto page = list({.limit = kPage, .offset = offset});
    if (!page) return fail(page.error());
    for (auto& archive : *page) {
      if (archive.id == id) return std::move(archive);
    }
    if (page->size() < kPage) return fail(Errc::NotFound, "there is no archive {}", id);
  }
}

Result<void> Retention::read(const Archive& archive,
                             const std::function<Result<void>(const std::string& row)>& take) {
  auto reader = archive::ArchiveReader::open((parts_.folder / archive.file).string());
  if (!reader) return fail(reader.error());
  if (auto taken = reader->each(take); !taken) return taken;
  if (reader->sha256() == archive.sha256) return {};
  return fail(Errc::Corrupt,
              "archive {} is not the file that was listed: its SHA-256 is {}, not {}", archive.file,
              reader->sha256().hex(), archive.sha256.hex());
}

Result<std::uint64_t> Retention::apply(const std::stop_token& stop) {
  const std::lock_guard lock(apply_mutex_);
  if (auto finished = finish(stop); !finished) return fail(finished.error());
  const auto records = archive_records(stop);
  if (!records) return records;
  const auto measurements = archive_measurements(stop);
  if (!measurements) return measurements;
  return *records + *measurements;
}

/// What was listed before the server ended, and not removed.
Result<void> Retention::finish(const std::stop_token& stop) {
  const auto left = parts_.store.archives.unremoved();
  if (!left) return fail(left.error());
  for (const Archive& archive : *left) {
    if (auto removed = remove_rows(archive, stop); !removed) return removed;
  }
  return {};
}

/// Only while the file is there.
Result<void> Retention::remove_rows(const Archive& archive, const std::stop_token& stop) {
  std::error_code ec;
  const auto file = parts_.folder / archive.file;
  if (std::filesystem::file_size(file, ec) != archive.bytes || ec) {
    return fail(Errc::Corrupt, "archive {} is not there as it was written: its rows stay",
                file.string());
  }
  while (!stop.stop_requested()) {
    const auto removed = parts_.store.archives.remove_rows(archive.id, options_.piece);
    if (!removed) return fail(removed.error());
    if (*removed == 0) return {};
  }
  return {};
}

Result<void> Retention::keep(archive::ArchiveWriter& writer, Archive archive,
                             const std::stop_token& stop) {
  const auto written = writer.end();
  if (!written) return fail(written.error());
  archive.sha256 = written->sha256;
  archive.bytes = written->bytes;
  archive.created = parts_.clock.now();
  const auto id = parts_.store.archives.add(archive, kWho);
  if (!id) return fail(id.error());
  archive.id = *id;
  process::log_info("archive {}: {} rows, {} bytes", archive.file, archive.rows, archive.bytes);
  return remove_rows(archive, stop);
}

/// Not what the reader has not got yet.
Result<std::vector<storage::ArchivableRecords>> Retention::archivable_records() {
  auto journals = parts_.store.archives.archivable_records();
  if (!journals || parts_.reader.empty()) return journals;
  const auto unread = parts_.store.record_readers.unread(parts_.reader);
  if (!unread) return fail(unread.error());
  for (auto& journal : *journals) {
    for (const auto& [cursor, last] : *unread) {
      if (cursor.machine != journal.machine || cursor.epoch != journal.epoch) continue;
      journal.last = std::min(journal.last, cursor.number);
    }
  }
  std::erase_if(*journals, [](const auto& journal) { return journal.first > journal.last; });
  return journals;
}

Result<std::uint64_t> Retention::archive_records(const std::stop_token& stop) {
  const RetentionRule& rule = options_.records;
  std::uint64_t made = 0;
  if (!rule.is_there()) return made;
  const UtcTime cutoff = rule.age ? parts_.clock.now() - *rule.age : UtcTime{};
  for (;;) {
    const auto journals = archivable_records();
    if (!journals) return fail(journals.error());
    const auto size =
        rule.rows ? parts_.store.archives.size(ArchiveKind::Records) : Result<std::uint64_t>(0);
    if (!size) return size;
    const std::uint64_t excess = rule.rows && *size > *rule.rows ? *size - *rule.rows : 0;
    bool has_made = false;
    for (const auto& journal : *journals) {
      if (stop.stop_requested()) return made;
      const auto done = archive_journal(journal, cutoff, options_.file_rows, stop);
      if (!done) return fail(done.error());
      made += *done ? 1 : 0;
      has_made = has_made || *done;
    }
    if (has_made) continue;  // what is old goes first, whatever the size is
    if (excess == 0 || journals->empty()) return made;
    // The journal whose oldest record is the oldest of all.
    const storage::ArchivableRecords* oldest = nullptr;
    UtcTime oldest_time{};
    for (const auto& journal : *journals) {
      const auto first = parts_.store.archives.records(journal, 1);
      if (!first) return fail(first.error());
      if (first->empty() || (oldest != nullptr && first->front().time >= oldest_time)) continue;
      oldest = &journal;
      oldest_time = first->front().time;
    }
    if (oldest == nullptr) return made;
    const auto done =
        archive_journal(*oldest, UtcTime::max(), std::min(excess, options_.file_rows), stop);
    if (!done) return fail(done.error());
    if (!*done) return made;
    ++made;
  }
}

Result<bool> Retention::archive_journal(storage::ArchivableRecords range, UtcTime cutoff,
                                        std::uint64_t rows, const std::stop_token& stop) {
  auto piece = parts_.store.archives.records(range, std::min(options_.piece, rows));
  if (!piece) return fail(piece.error());
  if (piece->empty() || piece->front().time >= cutoff) return false;
  Archive archive{
      .kind = ArchiveKind::Records,
      .machine = range.machine,
      .epoch = range.epoch,
      .first = range.first,
      .file = fmt::format("records-{}-{}-{}.jsonl.zst", range.machine, range.epoch, range.first),
      .first_time = piece->front().time};
  auto writer = archive::ArchiveWriter::begin(
      parts_.folder / archive.file,
      {std::string(to_string(archive.kind)), range.machine, parts_.database, parts_.made_by});
  if (!writer) return fail(writer.error());
  while (!piece->empty()) {
    if (stop.stop_requested()) return false;
    bool is_over = false;
    for (const storage::Record& record : *piece) {
      is_over = record.time >= cutoff || archive.rows >= rows;
      if (is_over) break;
      if (auto added = writer->add(record_line(record)); !added) return fail(added.error());
      archive.last = record.number;
      archive.last_time = record.time;
      ++archive.rows;
    }
    if (is_over || archive.rows >= rows) break;
    range.first = archive.last + 1;
    piece = parts_.store.archives.records(range, options_.piece);
    if (!piece) return fail(piece.error());
  }
  if (auto kept = keep(*writer, std::move(archive), stop); !kept) return fail(kept.error());
  return true;
}

Result<std::uint64_t> Retention::archive_measurements(const std::stop_token& stop) {
  const RetentionRule& rule = options_.measurements;
  std::uint64_t made = 0;
  if (!rule.is_there()) return made;
  constexpr auto kAll = std::numeric_limits<std::uint64_t>::max();
  const UtcTime cutoff = rule.age ? parts_.clock.now() - *rule.age : UtcTime{};
  while (!stop.stop_requested()) {
    auto done = archive_parts(cutoff, kAll, stop);
    if (!done) return fail(done.error());
    if (!*done && rule.rows) {
      const auto size = parts_.store.archives.size(ArchiveKind::Measurements);
      if (!size) return size;
      if (*size <= *rule.rows) return made;
      done = archive_parts(UtcTime::max(), *size - *rule.rows, stop);
      if (!done) return fail(done.error());
    }
    if (!*done) return made;
    ++made;
  }
  return made;
}

/// Oldest first, until it has `values` measurements; parts and findings are rows of the file, too.
Result<bool> Retention::archive_parts(UtcTime cutoff, std::uint64_t values,
                                      const std::stop_token& stop) {
  auto& store = parts_.store.archives;
  auto parts = store.ended_parts(0, options_.piece);
  if (!parts) return fail(parts.error());
  if (parts->empty() || *parts->front().ended >= cutoff) return false;
  Archive archive{.kind = ArchiveKind::Measurements,
                  .first = parts->front().id,
                  .file = fmt::format("measurements-{}.jsonl.zst", parts->front().id),
                  .first_time = parts->front().begun};
  auto writer = archive::ArchiveWriter::begin(
      parts_.folder / archive.file,
      {std::string(to_string(archive.kind)), "", parts_.database, parts_.made_by});
  if (!writer) return fail(writer.error());
  const auto add = [&](const json& row) -> Result<void> {
    ++archive.rows;
    return writer->add(one_line(row));
  };
  std::uint64_t taken = 0;
  const auto is_full = [&] { return archive.rows >= options_.file_rows || taken >= values; };
  while (!parts->empty() && !is_full()) {
    for (const auto& part : *parts) {
      if (stop.stop_requested()) return false;
      if (*part.ended >= cutoff || is_full()) break;
      if (auto added = add({{"part", part_json(part)}}); !added) return fail(added.error());
      std::optional<storage::MeasurementPlace> place;
      for (;;) {
        const auto found = store.measurements_of(part.id, place, options_.piece);
        if (!found) return fail(found.error());
        for (const auto& value : *found) {
          if (auto added = add({{"measurement", measurement::to_json(value)}}); !added)
            return fail(added.error());
        }
        taken += found->size();
        if (found->size() < options_.piece) break;
        place = storage::MeasurementPlace{found->back().time, found->back().id};
      }
      const auto findings = store.findings_of(part.id);
      if (!findings) return fail(findings.error());
      for (const auto& finding : *findings) {
        if (auto added = add({{"finding", finding_json(finding)}}); !added)
          return fail(added.error());
      }
      archive.last = part.id;
      archive.last_time = *part.ended;
    }
    if (archive.last != parts->back().id) break;  // the rest is younger, or the file is full
    parts = store.ended_parts(archive.last, options_.piece);
    if (!parts) return fail(parts.error());
  }
  if (auto kept = keep(*writer, std::move(archive), stop); !kept) return fail(kept.error());
  return true;
}

}  // namespace dripline::library
