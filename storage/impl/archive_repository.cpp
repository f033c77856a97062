#include "storage/impl/archive_repository.hpp"

#include <algorithm>

#include "storage/impl/audit_repository.hpp"
#include "storage/impl/measurement_query.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage {
namespace {

const std::string kSelectArchive =
    "SELECT id, kind, machine, epoch, first, last, file, sha256, rows, bytes, first_us, last_us, "
    "created_us, is_removed, is_counted FROM archive ";

Archive read_archive(const sql::Statement& row) {
  Archive archive;
  archive.id = row.number(0);
  archive.kind = row.text(1) == "measurements" ? ArchiveKind::Measurements : ArchiveKind::Records;
  archive.machine = row.text(2);
  archive.epoch = row.number(3);
  archive.first = row.number(4);
  archive.last = row.number(5);
  archive.file = row.text(6);
  std::ranges::copy(row.blob(7).first(Digest::kSize), archive.sha256.bytes.begin());
  archive.rows = row.number(8);
  archive.bytes = row.number(9);
  archive.first_time = row.time(10);
  archive.last_time = row.time(11);
  archive.created = row.time(12);
  archive.is_removed = row.integer(13) != 0;
  archive.is_counted = row.integer(14) != 0;
  return archive;
}

/// What a control keeps is read from its latest report (RecordStore::memory_reports), however old.
constexpr const char* kNoMemory = "NOT (kind = 'message' AND device = 'memory')";

Result<std::optional<Archive>> find_archive(sql::Database& database, std::uint64_t id) {
  static const std::string kSql = kSelectArchive + "WHERE id = ?1";
  return sql::first_row(database, kSql, read_archive, id);
}

Result<std::uint64_t> remove_records(sql::Database& database, const Archive& archive,
                                     std::uint64_t limit) {
  static const std::string kSql = fmt::format(
      "DELETE FROM record WHERE machine = (SELECT id FROM machine WHERE name = ?1) "
      "AND epoch = ?2 AND number IN (SELECT number FROM record WHERE machine = "
      "(SELECT id FROM machine WHERE name = ?1) AND epoch = ?2 AND number BETWEEN ?3 "
      "AND ?4 AND {} ORDER BY number LIMIT ?5)",
      kNoMemory);
  auto done =
      sql::run(database, kSql, archive.machine, archive.epoch, archive.first, archive.last, limit);
  if (!done) return fail(done.error());
  return database.changes();
}

/// The part is about to leave its table: its run keeps its verdict.
Result<void> count_part(sql::Database& database, const Archive& archive, std::int64_t part) {
  static const std::string kSql =
      "INSERT INTO archived_part (run, archive, template, verdict, parts) SELECT run, ?2, "
      "template, "
      "verdict, 1 FROM measured_part WHERE id = ?1 AND run IS NOT NULL AND is_superseded = 0 "
      "ON CONFLICT (run, archive, template, verdict) DO UPDATE SET parts = archived_part.parts + 1";
  return sql::run(database, kSql, part, archive.id);
}

/// Of the first part that is still there: its values, its findings, then the part.
Result<std::uint64_t> remove_measurements(sql::Database& database, const Archive& archive,
                                          std::uint64_t limit) {
  const auto part = sql::first_row(
      database, "SELECT min(id) FROM measured_part WHERE id BETWEEN ?1 AND ?2",
      [](const sql::Statement& row) { return row.optional_integer(0); }, archive.first,
      archive.last);
  if (!part) return fail(part.error());
  if (!*part || !**part) return 0;
  for (const char* sql :
       {"DELETE FROM measurement WHERE id IN (SELECT id FROM measurement WHERE part = ?1 LIMIT ?2)",
        "DELETE FROM report_finding WHERE id IN (SELECT id FROM report_finding WHERE part = ?1 "
        "LIMIT ?2)"}) {
    if (auto done = sql::run(database, sql, ***part, limit); !done) return fail(done.error());
    if (database.changes() > 0) return database.changes();
  }
  if (auto counted = count_part(database, archive, ***part); !counted) return fail(counted.error());
  auto done = sql::run(database, "DELETE FROM measured_part WHERE id = ?1", ***part);
  if (!done) return fail(done.error());
  return database.changes();
}

}  // namespace

std::string_view to_string(ArchiveKind kind) {
  return kind == ArchiveKind::Records ? "records" : "measurements";
}

Result<std::vector<ArchivableRecords>> ArchiveRepository::archivable_records() {
  static const std::string kSql = fmt::format(
      "SELECT machine.name, e.epoch, "
      "(SELECT min(number) FROM record WHERE machine = e.machine AND epoch = e.epoch AND {}), "
      // As long as nothing is assigned nothing is derived, and no cursor moves.
      "CASE WHEN EXISTS (SELECT 1 FROM report_template_assignment) THEN coalesce(c.number, 0) "
      "ELSE e.last END, "
      "(SELECT min(number) FROM record WHERE machine = e.machine AND epoch = e.epoch AND run IN "
      "(SELECT id FROM run WHERE machine = e.machine AND state IN ('ordered', 'active'))) "
      "FROM record_epoch AS e JOIN machine ON machine.id = e.machine LEFT JOIN measurement_cursor "
      "AS c ON c.machine = e.machine AND c.epoch = e.epoch ORDER BY machine.name, e.epoch",
      kNoMemory);
  const auto rows = connections_.read([&](sql::Database& database) {
    return sql::all_rows(database, kSql, [](const sql::Statement& row) {
      ArchivableRecords range{.machine = row.text(0), .epoch = row.number(1)};
      if (row.is_null(2)) return range;  // all are taken out
      range.first = row.number(2);
      range.last = row.number(3);
      if (!row.is_null(4)) range.last = std::min(range.last, row.number(4) - 1);
      return range;
    });
  });
  if (!rows) return rows;
  std::vector<ArchivableRecords> some;
  std::ranges::copy_if(*rows, std::back_inserter(some), [](const ArchivableRecords& range) {
    return range.first > 0 && range.first <= range.last;
  });
  return some;
}

Result<std::vector<Record>> ArchiveRepository::records(const ArchivableRecords& range,
                                                       std::uint64_t limit) {
  static const std::string kSql = fmt::format(
      "SELECT epoch, number, time_us, run, kind, block, line, sequence, device, text, received_us "
      "FROM record WHERE machine = (SELECT id FROM machine WHERE name = ?1) AND epoch = ?2 AND "
      "number BETWEEN ?3 AND ?4 AND {} ORDER BY number LIMIT ?5",
      kNoMemory);
  return connections_.read([&](sql::Database& database) {
    return sql::all_rows(
        database, kSql,
        [&](const sql::Statement& row) {
          return Record{.machine = range.machine,
                        .epoch = row.number(0),
                        .number = row.number(1),
                        .time = row.time(2),
                        .run = row.optional_text(3).value_or(""),
                        .kind = row.text(4),
                        .block = row.number(5),
                        .line = row.number(6),
                        .sequence = row.integer(7),
                        .device = row.text(8),
                        .text = row.text(9),
                        .received = row.optional_time(10)};
        },
        range.machine, range.epoch, range.first, range.last, limit);
  });
}

Result<std::vector<MeasuredPart>> ArchiveRepository::ended_parts(std::uint64_t after,
                                                                 std::uint64_t limit) {
  return connections_.read([&](sql::Database& database) -> Result<std::vector<MeasuredPart>> {
    const auto ids = sql::all_rows(
        database,
        "SELECT id FROM measured_part WHERE id > ?1 AND id < coalesce((SELECT min(id) FROM "
        "measured_part WHERE id > ?1 AND ended_us IS NULL), 9223372036854775807) ORDER BY id LIMIT "
        "?2",
        [](const sql::Statement& row) { return row.number(0); }, after, limit);
    if (!ids) return fail(ids.error());
    std::vector<MeasuredPart> parts;
    for (const std::uint64_t id : *ids) {
      auto part = query_part(database, id);
      if (!part) return fail(part.error());
      if (*part) parts.push_back(std::move(**part));
    }
    return parts;
  });
}

Result<std::vector<measurement::Measurement>> ArchiveRepository::measurements_of(
    std::uint64_t part, const std::optional<MeasurementPlace>& after, std::uint64_t limit) {
  MeasurementFilter filter;
  filter.part_id = part;
  filter.with_superseded = true;
  return connections_.read([&](sql::Database& database) {
    return query_measurements(database, filter, {.from = after, .is_newest_first = false}, limit);
  });
}

Result<std::vector<ReportFinding>> ArchiveRepository::findings_of(std::uint64_t part) {
  return connections_.read(
      [&](sql::Database& database) { return query_findings_of(database, part); });
}

Result<std::uint64_t> ArchiveRepository::size(ArchiveKind kind) {
  // Numbers and ids have no gaps but at their beginning.
  static const std::string kRecords = fmt::format(
      "SELECT coalesce(sum(e.last + 1 - (SELECT min(number) FROM record WHERE machine = e.machine "
      "AND epoch = e.epoch AND {})), 0) FROM record_epoch AS e",
      kNoMemory);
  const std::string sql =
      kind == ArchiveKind::Records
          ? kRecords
          : "SELECT coalesce((SELECT max(id) FROM measurement) - (SELECT min(id) FROM measurement) "
            "+ 1, 0)";
  const auto count =
      connections_.read([&](sql::Database& database) { return database.integer(sql); });
  if (!count) return fail(count.error());
  return static_cast<std::uint64_t>(*count);
}

Result<std::uint64_t> ArchiveRepository::add(const Archive& archive, const Actor& who) {
  return connections_.write([&](sql::Database& database) -> Result<std::uint64_t> {
    const auto id = sql::insert(
        database,
        "INSERT INTO archive (kind, machine, epoch, first, last, file, sha256, rows, bytes, "
        "first_us, last_us, created_us) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12) "
        "RETURNING id",
        to_string(archive.kind), archive.machine, archive.epoch, archive.first, archive.last,
        archive.file, std::span<const std::byte>(archive.sha256.bytes), archive.rows, archive.bytes,
        archive.first_time, archive.last_time, archive.created);
    if (!id) return fail(id.error());
    const auto noted =
        add_audit(database, {.time = archive.created,
                             .who = who,
                             .action = "archive.create",
                             .subject = archive.file,
                             .detail = fmt::format("{} {}, sha256 {}", archive.rows,
                                                   to_string(archive.kind), archive.sha256.hex())});
    if (!noted) return fail(noted.error());
    return static_cast<std::uint64_t>(*id);
  });
}

Result<std::uint64_t> ArchiveRepository::remove_rows(std::uint64_t id, std::uint64_t limit) {
  return connections_.write(
      [&](sql::Database& database) -> Result<std::uint64_t> {
        const auto archive = find_archive(database, id);
        if (!archive) return fail(archive.error());
        if (!*archive) return fail(Errc::NotFound, "archive {} is not listed", id);
        const auto removed = (*archive)->kind == ArchiveKind::Records
                                 ? remove_records(database, **archive, limit)
                                 : remove_measurements(database, **archive, limit);
        if (!removed || *removed > 0) return removed;
        const auto done = sql::run(database, "UPDATE archive SET is_removed = 1 WHERE id = ?1", id);
        if (!done) return fail(done.error());
        return 0;
      },
      Durability::Normal);
}

Result<std::vector<Archive>> ArchiveRepository::list(Page page) {
  static const std::string kSql = kSelectArchive + "ORDER BY id DESC LIMIT ?1 OFFSET ?2";
  return connections_.read([&](sql::Database& database) {
    return sql::all_rows(database, kSql, read_archive, page.limit, page.offset);
  });
}

Result<std::vector<Archive>> ArchiveRepository::unremoved() {
  static const std::string kSql = kSelectArchive + "WHERE is_removed = 0 ORDER BY id";
  return connections_.read(
      [&](sql::Database& database) { return sql::all_rows(database, kSql, read_archive); });
}

Result<std::vector<Archive>> ArchiveRepository::uncounted() {
  static const std::string kSql = kSelectArchive + "WHERE is_counted = 0 ORDER BY id";
  return connections_.read(
      [&](sql::Database& database) { return sql::all_rows(database, kSql, read_archive); });
}

}  // namespace dripline::storage
