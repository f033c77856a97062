#include "storage/impl/measurement_repository.hpp"

#include <algorithm>
#include <map>

#include "storage/impl/measurement_query.hpp"
#include "storage/impl/repositories.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage {
namespace {

using measurement::Measurement;

std::optional<std::string> optional_text(const std::string& text) {
  if (text.empty()) return std::nullopt;
  return text;
}

/// The row id that `find` gives, or the one that `insert` makes.
template <class... Values>
Result<std::int64_t> intern(sql::Database& database, const std::string& find,
                            const std::string& insert, const Values&... values) {
  const auto known = sql::first_row(
      database, find, [](const sql::Statement& row) { return row.integer(0); }, values...);
  if (!known) return fail(known.error());
  if (*known) return **known;
  return sql::insert(database, insert, values...);
}

/// Rows of characteristics, each looked up once in a batch.
class Characteristics {
 public:
  struct Rows {
    std::int64_t name = 0, characteristic = 0;
  };
  explicit Characteristics(sql::Database& database) : database_(database) {}

  Result<Rows> rows_of(const Measurement& measurement) {
    const auto& wanted = measurement.characteristic;
    auto& known = known_[wanted.name];
    for (const Known& one : known) {
      if (one.characteristic == wanted && one.tool == measurement.tool) return one.rows;
    }
    static const std::string kFindName = "SELECT id FROM characteristic_name WHERE name = ?1";
    static const std::string kAddName =
        "INSERT INTO characteristic_name (name) VALUES (?1) RETURNING id";
    const auto name = intern(database_, kFindName, kAddName, wanted.name);
    if (!name) return fail(name.error());
    static const std::string kFind =
        "SELECT id FROM characteristic WHERE name = ?1 AND nominal IS NOT DISTINCT FROM ?2 AND "
        "lower IS "
        "NOT DISTINCT FROM ?3 AND upper IS NOT DISTINCT FROM ?4 AND unit = ?5 AND decimals = ?6 "
        "AND tool = ?7";
    static const std::string kAdd =
        "INSERT INTO characteristic (name, nominal, lower, upper, unit, decimals, tool) VALUES "
        "(?1, ?2, ?3, ?4, ?5, ?6, ?7) RETURNING id";
    const auto row = intern(database_, kFind, kAdd, *name, wanted.nominal, wanted.lower,
                            wanted.upper, wanted.unit, wanted.decimals, measurement.tool);
    if (!row) return fail(row.error());
    const Rows rows{*name, *row};
    if (known.size() < kMaxKnown) known.push_back({wanted, measurement.tool, rows});
    return rows;
  }

 private:
  static constexpr std::size_t kMaxKnown = 16;  ///< of a name
  struct Known {
    measurement::Characteristic characteristic;
    std::string tool;
    Rows rows;
  };
  sql::Database& database_;
  std::map<std::string, std::vector<Known>> known_;
};

Result<void> save_parts(sql::Database& database, std::int64_t machine,
                        const std::vector<MeasuredPart>& parts) {
  static const std::string kSave =
      "INSERT INTO measured_part (id, machine, run, program, revision, template, version, number, "
      "serial, measurements, findings, verdict, begun_us, ended_us) VALUES (?1, ?2, ?3, ?4, ?5, "
      "?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14) ON CONFLICT (id) DO UPDATE SET number = "
      "excluded.number, serial = excluded.serial, measurements = excluded.measurements, findings = "
      "excluded.findings, verdict = excluded.verdict, ended_us = excluded.ended_us WHERE "
      "measured_part.machine = excluded.machine";
  std::uint64_t last = 0;
  for (const MeasuredPart& part : parts) {
    auto saved = sql::run(database, kSave, part.id, machine, optional_text(part.run), part.program,
                          part.revision, part.template_name, part.template_version, part.number,
                          part.serial, part.measurements, part.findings,
                          static_cast<int>(part.verdict), part.begun, part.ended);
    if (!saved) return saved;
    if (database.changes() == 0)
      return fail(Errc::Conflict, "part {} is another machine's", part.id);
    last = std::max(last, part.id);
  }
  return sql::run(database, "UPDATE measured_part_number SET last = max(last, ?1)", last);
}

Result<void> add_measurements(sql::Database& database, std::int64_t machine,
                              const std::vector<Measurement>& measurements) {
  static const std::string kAdd =
      "INSERT INTO measurement (part, machine, name, characteristic, epoch, number, item, time_us, "
      "actual, verdict, block, line) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12)";
  auto add = database.prepare(kAdd);
  if (!add) return fail(add.error());
  Characteristics characteristics(database);
  for (const Measurement& one : measurements) {
    const auto rows = characteristics.rows_of(one);
    if (!rows) return fail(rows.error());
    auto added = add->bind(one.part_id, machine, rows->name, rows->characteristic, one.record.epoch,
                           one.record.number, one.item, one.time, one.actual,
                           static_cast<int>(one.verdict), one.block, one.line)
                     .post();
    if (!added) return added;
  }
  return {};
}

Result<void> add_findings(sql::Database& database, std::int64_t machine,
                          const std::vector<ReportFinding>& findings) {
  static const std::string kAdd =
      "INSERT INTO report_finding (machine, part, run, epoch, number, time_us, kind, text) VALUES "
      "(?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)";
  for (const ReportFinding& one : findings) {
    std::optional<std::uint64_t> part;
    if (one.part_id != 0) part = one.part_id;
    auto added = sql::run(database, kAdd, machine, part, optional_text(one.run), one.record.epoch,
                          one.record.number, one.time, one.kind, one.text);
    if (!added) return added;
  }
  return {};
}

Result<void> add_derived(sql::Database& database, std::int64_t machine, const DerivedBatch& batch) {
  if (auto done = save_parts(database, machine, batch.parts); !done) return done;
  if (auto done = add_measurements(database, machine, batch.measurements); !done) return done;
  return add_findings(database, machine, batch.findings);
}

Result<void> put_state(sql::Database& database, std::int64_t machine, const std::string& state) {
  return sql::run(database,
                  "INSERT INTO measurement_state (machine, state) VALUES (?1, ?2) ON CONFLICT "
                  "(machine) DO UPDATE SET state = excluded.state",
                  machine, state);
}

Result<void> move_cursor(sql::Database& database, std::int64_t machine, const DerivedBatch& batch) {
  const auto now = sql::first_row(
      database, "SELECT number FROM measurement_cursor WHERE machine = ?1 AND epoch = ?2",
      [](const sql::Statement& row) { return row.number(0); }, machine, batch.epoch);
  if (!now) return fail(now.error());
  if (now->value_or(0) != batch.after) {
    return fail(Errc::Conflict, "records of {} epoch {} are derived up to {}, not {}",
                batch.machine, batch.epoch, now->value_or(0), batch.after);
  }
  auto moved = sql::run(database,
                        "INSERT INTO measurement_cursor (machine, epoch, number) VALUES (?1, "
                        "?2, ?3) ON CONFLICT (machine, epoch) DO UPDATE SET number = "
                        "excluded.number",
                        machine, batch.epoch, batch.through);
  if (!moved) return moved;
  return put_state(database, machine, batch.state);
}

}  // namespace

Result<void> MeasurementRepository::save_state(const std::string& machine,
                                               const std::string& state) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto known = known_machine(database, machine);
    if (!known) return fail(known.error());
    return put_state(database, *known, state);
  });
}

Result<std::vector<UnderivedRecords>> MeasurementRepository::underived() {
  static const std::string kSql =
      "SELECT machine.name, e.epoch, coalesce(c.number, 0), e.last FROM record_epoch AS e "
      "JOIN machine ON machine.id = e.machine LEFT JOIN measurement_cursor AS c "
      "ON c.machine = e.machine AND c.epoch = e.epoch WHERE e.last > coalesce(c.number, 0) "
      "ORDER BY machine.name, e.epoch";
  return connections_.read([&](sql::Database& database) {
    return sql::all_rows(database, kSql, [](const sql::Statement& row) {
      return UnderivedRecords{.machine = row.text(0),
                              .epoch = row.number(1),
                              .derived = row.number(2),
                              .last = row.number(3)};
    });
  });
}

Result<std::string> MeasurementRepository::state(const std::string& machine) {
  static const std::string kSql =
      "SELECT state FROM measurement_state WHERE machine = (SELECT id FROM machine WHERE name = "
      "?1)";
  auto found = connections_.read([&](sql::Database& database) {
    return sql::first_row(
        database, kSql, [](const sql::Statement& row) { return row.text(0); }, machine);
  });
  if (!found) return fail(found.error());
  return found->value_or("");
}

Result<std::uint64_t> MeasurementRepository::next_part_id() {
  const auto last = connections_.read([](sql::Database& database) {
    return database.integer("SELECT last FROM measured_part_number");
  });
  if (!last) return fail(last.error());
  return static_cast<std::uint64_t>(*last) + 1;
}

Result<void> MeasurementRepository::commit(const DerivedBatch& batch) {
  return connections_.write(
      [&](sql::Database& database) -> Result<void> {
        const auto machine = known_machine(database, batch.machine);
        if (!machine) return fail(machine.error());
        if (auto moved = move_cursor(database, *machine, batch); !moved) return moved;
        return add_derived(database, *machine, batch);
      },
      Durability::Normal);
}

Result<void> MeasurementRepository::replace(const std::string& run, const DerivedBatch& batch) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto machine = known_machine(database, batch.machine);
    if (!machine) return fail(machine.error());
    for (const char* sql :
         {"UPDATE measurement SET is_superseded = 1 WHERE is_superseded = 0 AND part IN "
          "(SELECT id FROM measured_part WHERE run = ?1 AND machine = ?2)",
          "UPDATE report_finding SET is_superseded = 1 WHERE run = ?1 AND machine = ?2",
          "UPDATE measured_part SET is_superseded = 1 WHERE run = ?1 AND machine = ?2"}) {
      if (auto done = sql::run(database, sql, run, *machine); !done) return done;
    }
    return add_derived(database, *machine, batch);
  });
}

Result<std::vector<Measurement>> MeasurementRepository::list(
    const MeasurementFilter& filter, const std::optional<MeasurementPlace>& after,
    std::uint64_t limit) {
  return connections_.read([&](sql::Database& database) {
    return query_measurements(database, filter, {.from = after, .is_newest_first = false}, limit);
  });
}

Result<std::vector<Measurement>> MeasurementRepository::list_newest(
    const MeasurementFilter& filter, const std::optional<MeasurementPlace>& before,
    std::uint64_t limit) {
  return connections_.read([&](sql::Database& database) {
    return query_measurements(database, filter, {.from = before, .is_newest_first = true}, limit);
  });
}

Result<std::vector<MeasuredPart>> MeasurementRepository::parts(const PartFilter& filter,
                                                               Page page) {
  return connections_.read(
      [&](sql::Database& database) { return query_parts(database, filter, page); });
}

Result<MeasuredPart> MeasurementRepository::part(std::uint64_t id) {
  auto found = connections_.read([&](sql::Database& database) { return query_part(database, id); });
  if (!found) return fail(found.error());
  if (!*found) return fail(Errc::NotFound, "part {} is not known", id);
  return std::move(**found);
}

Result<RunParts> MeasurementRepository::parts_of_run(const std::string& run) {
  struct Row {
    std::uint64_t verdict = 0, parts = 0;
    std::optional<std::string> archive;
  };
  static const std::string kSql =
      "SELECT verdict, count(*), NULL, 0 AS place FROM measured_part WHERE run = ?1 AND "
      "is_superseded = 0 GROUP BY verdict UNION ALL "
      "SELECT a.verdict, sum(a.parts), archive.file, archive.id FROM archived_part AS a JOIN "
      "archive ON archive.id = a.archive WHERE a.run = ?1 GROUP BY archive.id, a.verdict "
      "ORDER BY place";
  const auto rows = connections_.read([&](sql::Database& database) {
    return sql::all_rows(
        database, kSql,
        [](const sql::Statement& row) {
          return Row{row.number(0), row.number(1), row.optional_text(2)};
        },
        run);
  });
  if (!rows) return fail(rows.error());
  RunParts counts;
  for (const Row& row : *rows) {
    counts.verdicts.at(row.verdict) += row.parts;
    if (!row.archive) continue;
    counts.archived += row.parts;
    if (counts.archives.empty() || counts.archives.back() != *row.archive)
      counts.archives.push_back(*row.archive);
  }
  return counts;
}

Result<std::vector<ReportFinding>> MeasurementRepository::findings(const PartFilter& filter,
                                                                   Page page) {
  return connections_.read(
      [&](sql::Database& database) { return query_findings(database, filter, page); });
}

Result<std::vector<std::string>> MeasurementRepository::characteristics(
    const std::optional<std::string>& machine) {
  return connections_.read(
      [&](sql::Database& database) { return query_characteristics(database, machine); });
}

}  // namespace dripline::storage
