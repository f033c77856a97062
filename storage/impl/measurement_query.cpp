#include "storage/impl/measurement_query.hpp"

#include <algorithm>
#include <limits>

#include "storage/sql/query.hpp"

namespace dripline::storage {
namespace {

using measurement::Measurement;
using measurement::Verdict;

/// The schema allows only these numbers.
Verdict verdict_of(std::int64_t number) {
  return static_cast<Verdict>(std::clamp<std::int64_t>(number, 0, 3));
}

struct Key {
  std::int64_t time = 0, id = 0;
};

/// Rows of one machine or one part, in an order that their index has.
enum class Along : std::uint8_t { Part, MachineAndName, Machine, OutsideLimits };

/// ?1 machine or part, ?2 name, ?3 since, ?4 until, ?5 ?6 the place, ?7 superseded ones, ?8
/// verdict, ?9 limit.
std::string key_sql(Along along, bool is_newest_first) {
  const char* compare = is_newest_first ? "<" : ">";
  const char* direction = is_newest_first ? " DESC" : "";
  std::string sql = "SELECT time_us, id FROM measurement WHERE ";
  sql += along == Along::Part ? "part = ?1 " : "machine = ?1 ";
  sql += along == Along::MachineAndName ? "AND name = ?2 " : "AND (?2 IS NULL OR name = ?2) ";
  if (along == Along::OutsideLimits) sql += "AND verdict >= 2 ";
  sql += "AND time_us >= ?3 AND time_us < ?4 ";
  sql += along == Along::Part ? fmt::format("AND id {} ?6 AND ?5 IS NOT NULL ", compare)
                              : fmt::format("AND (time_us, id) {} (?5, ?6) ", compare);
  sql += "AND is_superseded <= ?7 AND (?8 IS NULL OR verdict = ?8) ";
  sql += along == Along::Part
             ? fmt::format("ORDER BY id{} LIMIT ?9", direction)
             : fmt::format("ORDER BY time_us{}, id{} LIMIT ?9", direction, direction);
  return sql;
}

const std::string& key_sql_of(Along along, bool is_newest_first) {
  static const auto kTexts = [] {
    std::vector<std::string> all;
    for (const auto one :
         {Along::Part, Along::MachineAndName, Along::Machine, Along::OutsideLimits}) {
      all.push_back(key_sql(one, false));
      all.push_back(key_sql(one, true));
    }
    return all;
  }();
  return kTexts.at(static_cast<std::size_t>(along) * 2 + (is_newest_first ? 1 : 0));
}

Result<std::vector<std::int64_t>> machines_of(sql::Database& database,
                                              const std::optional<std::string>& name) {
  return sql::all_rows(
      database, "SELECT id FROM machine WHERE ?1 IS NULL OR name = ?1 ORDER BY id",
      [](const sql::Statement& row) { return row.integer(0); }, name);
}

/// Those of another machine than the filter's are left out: what a gateway reports of foreign
/// runs is not shown.
Result<std::vector<std::int64_t>> parts_of(sql::Database& database,
                                           const MeasurementFilter& filter) {
  static const std::string kSql =
      "SELECT id FROM measured_part WHERE {} AND (?2 IS NULL OR machine = (SELECT id FROM machine "
      "WHERE name = ?2)) ORDER BY id";
  static const std::string kOne = fmt::format(fmt::runtime(kSql), "id = ?1");
  static const std::string kOfRun = fmt::format(fmt::runtime(kSql), "run = ?1");
  const auto read = [](const sql::Statement& row) { return row.integer(0); };
  return filter.part_id ? sql::all_rows(database, kOne, read, *filter.part_id, filter.machine)
                        : sql::all_rows(database, kOfRun, read, *filter.run, filter.machine);
}

/// What the keys are looked for with.
struct Search {
  std::optional<std::int64_t> name;
  Along along = Along::Machine;
  std::vector<std::int64_t> owners;  ///< machines or parts
};

Result<Search> search_of(sql::Database& database, const MeasurementFilter& filter) {
  Search search;
  if (filter.characteristic) {
    const auto name = sql::first_row(
        database, "SELECT id FROM characteristic_name WHERE name = ?1",
        [](const sql::Statement& row) { return row.integer(0); }, *filter.characteristic);
    if (!name) return fail(name.error());
    if (!*name) return search;  // never measured
    search.name = **name;
    search.along = Along::MachineAndName;
  } else if (filter.verdict && *filter.verdict >= Verdict::Rework) {
    search.along = Along::OutsideLimits;
  }
  if (filter.run || filter.part_id) search.along = Along::Part;
  auto owners = search.along == Along::Part ? parts_of(database, filter)
                                            : machines_of(database, filter.machine);
  if (!owners) return fail(owners.error());
  search.owners = *std::move(owners);
  return search;
}

Result<std::vector<Key>> find_keys(sql::Database& database, const MeasurementFilter& filter,
                                   const MeasurementOrder& order, std::uint64_t limit) {
  const auto search = search_of(database, filter);
  if (!search) return fail(search.error());
  constexpr auto kFirst = std::numeric_limits<std::int64_t>::min();
  constexpr auto kLast = std::numeric_limits<std::int64_t>::max();
  const Key outermost = order.is_newest_first ? Key{kLast, kLast} : Key{kFirst, 0};
  const Key from = order.from ? Key{order.from->time.time_since_epoch().count(),
                                    static_cast<std::int64_t>(order.from->id)}
                              : outermost;
  std::optional<std::int64_t> verdict;
  if (filter.verdict) verdict = static_cast<std::int64_t>(*filter.verdict);
  const auto micros = [](const std::optional<UtcTime>& time, std::int64_t otherwise) {
    return time ? time->time_since_epoch().count() : otherwise;
  };
  // Where the page begins limits the time too: SQLite takes one bound of each side to the index,
  // and would read from `since` on for every page.
  std::int64_t since = micros(filter.since, kFirst), until = micros(filter.until, kLast);
  if (order.from && order.is_newest_first) until = std::min(until, from.time + 1);
  if (order.from && !order.is_newest_first) since = std::max(since, from.time);
  std::vector<Key> keys;
  for (const std::int64_t owner : search->owners) {
    const auto found = sql::all_rows(
        database, key_sql_of(search->along, order.is_newest_first),
        [](const sql::Statement& row) {
          return Key{row.integer(0), row.integer(1)};
        },
        owner, search->name, since, until, from.time, from.id, filter.with_superseded ? 1 : 0,
        verdict, limit);
    if (!found) return fail(found.error());
    keys.insert(keys.end(), found->begin(), found->end());
  }
  const bool by_id = search->along == Along::Part;
  const auto is_before = [&](const Key& a, const Key& b) {
    const bool is_less = by_id ? a.id < b.id : std::pair(a.time, a.id) < std::pair(b.time, b.id);
    return order.is_newest_first ? !is_less && a.id != b.id : is_less;
  };
  std::ranges::sort(keys, is_before);
  if (keys.size() > limit) keys.resize(limit);
  return keys;
}

Measurement read_measurement(const sql::Statement& row) {
  const auto optional_real = [&](int column) { return row.optional_real(column); };
  Measurement made;
  made.id = row.number(0);
  made.machine = row.text(1);
  made.run = row.optional_text(2).value_or("");
  made.program = row.text(3);
  made.revision = row.number(4);
  made.block = row.number(5);
  made.line = row.number(6);
  made.part_id = row.number(7);
  made.part = row.text(8);
  made.serial = row.text(9);
  made.tool = row.text(10);
  made.characteristic = {.name = row.text(11),
                         .nominal = optional_real(12),
                         .lower = optional_real(13),
                         .upper = optional_real(14),
                         .unit = row.text(15),
                         .decimals = static_cast<std::uint8_t>(row.integer(16))};
  made.actual = row.real(17);
  made.time = row.time(18);
  made.record = {.epoch = row.number(19), .number = row.number(20)};
  made.item = static_cast<std::uint32_t>(row.number(21));
  made.verdict = verdict_of(row.integer(22));
  return made;
}

const std::string kPartSelect =
    "SELECT p.id, machine.name, p.run, p.program, p.revision, p.template, p.version, p.number, "
    "p.serial, p.measurements, p.findings, p.verdict, p.begun_us, p.ended_us, p.is_superseded "
    "FROM measured_part AS p JOIN machine ON machine.id = p.machine ";

MeasuredPart read_part(const sql::Statement& row) {
  return {.id = row.number(0),
          .machine = row.text(1),
          .run = row.optional_text(2).value_or(""),
          .program = row.text(3),
          .revision = row.number(4),
          .template_name = row.text(5),
          .template_version = row.number(6),
          .number = row.text(7),
          .serial = row.text(8),
          .measurements = row.number(9),
          .findings = row.number(10),
          .verdict = verdict_of(row.integer(11)),
          .begun = row.time(12),
          .ended = row.optional_time(13),
          .is_superseded = row.integer(14) != 0};
}

const std::string kFindingSelect =
    "SELECT p.id, machine.name, p.run, coalesce(p.part, 0), p.epoch, p.number, p.time_us, p.kind, "
    "p.text FROM report_finding AS p JOIN machine ON machine.id = p.machine ";

ReportFinding read_finding(const sql::Statement& row) {
  return {.id = row.number(0),
          .machine = row.text(1),
          .run = row.optional_text(2).value_or(""),
          .part_id = row.number(3),
          .record = {.epoch = row.number(4), .number = row.number(5)},
          .time = row.time(6),
          .kind = row.text(7),
          .text = row.text(8)};
}

/// Which rows a PartFilter lets through, by the index that fits it; `?1` run, `?2` machine, `?3`
/// superseded ones.
const char* condition_of(const PartFilter& filter) {
  if (filter.run) {
    return "WHERE p.run = ?1 AND (?2 IS NULL OR machine.name = ?2) AND p.is_superseded <= ?3 ";
  }
  if (filter.machine) {
    return "WHERE ?1 IS NULL AND p.machine = (SELECT id FROM machine WHERE name = ?2) "
           "AND p.is_superseded <= ?3 ";
  }
  return "WHERE ?1 IS NULL AND ?2 IS NULL AND p.is_superseded <= ?3 ";
}

}  // namespace

Result<std::vector<Measurement>> query_measurements(sql::Database& database,
                                                    const MeasurementFilter& filter,
                                                    const MeasurementOrder& order,
                                                    std::uint64_t limit) {
  static const std::string kRow =
      "SELECT m.id, machine.name, p.run, p.program, p.revision, m.block, m.line, m.part, p.number, "
      "p.serial, c.tool, n.name, c.nominal, c.lower, c.upper, c.unit, c.decimals, m.actual, "
      "m.time_us, m.epoch, m.number, m.item, m.verdict FROM measurement AS m "
      "JOIN machine ON machine.id = m.machine JOIN measured_part AS p ON p.id = m.part "
      "JOIN characteristic AS c ON c.id = m.characteristic "
      "JOIN characteristic_name AS n ON n.id = m.name WHERE m.id = ?1";
  const auto keys = find_keys(database, filter, order, limit);
  if (!keys) return fail(keys.error());
  std::vector<Measurement> rows;
  rows.reserve(keys->size());
  for (const Key& key : *keys) {
    auto row = sql::first_row(database, kRow, read_measurement, key.id);
    if (!row) return fail(row.error());
    if (*row) rows.push_back(std::move(**row));
  }
  return rows;
}

Result<std::vector<MeasuredPart>> query_parts(sql::Database& database, const PartFilter& filter,
                                              Page page) {
  std::optional<std::int64_t> verdict;
  if (filter.verdict) verdict = static_cast<std::int64_t>(*filter.verdict);
  return sql::all_rows(database,
                       kPartSelect + condition_of(filter) +
                           "AND (?4 IS NULL OR p.verdict = ?4) ORDER BY p.id DESC LIMIT ?5 "
                           "OFFSET ?6",
                       read_part, filter.run, filter.machine, filter.with_superseded ? 1 : 0,
                       verdict, page.limit, page.offset);
}

Result<std::optional<MeasuredPart>> query_part(sql::Database& database, std::uint64_t id) {
  static const std::string kSql = kPartSelect + "WHERE p.id = ?1";
  return sql::first_row(database, kSql, read_part, id);
}

Result<std::vector<ReportFinding>> query_findings_of(sql::Database& database, std::uint64_t part) {
  static const std::string kSql = kFindingSelect + "WHERE p.part = ?1 ORDER BY p.id";
  return sql::all_rows(database, kSql, read_finding, part);
}

Result<std::vector<ReportFinding>> query_findings(sql::Database& database, const PartFilter& filter,
                                                  Page page) {
  return sql::all_rows(database,
                       kFindingSelect + condition_of(filter) + "ORDER BY p.id LIMIT ?4 OFFSET ?5",
                       read_finding, filter.run, filter.machine, filter.with_superseded ? 1 : 0,
                       page.limit, page.offset);
}

Result<std::vector<std::string>> query_characteristics(sql::Database& database,
                                                       const std::optional<std::string>& machine) {
  const auto read = [](const sql::Statement& row) { return row.text(0); };
  if (!machine) {
    return sql::all_rows(database, "SELECT name FROM characteristic_name ORDER BY name LIMIT 10000",
                         read);
  }
  return sql::all_rows(
      database,
      "SELECT name FROM characteristic_name AS n WHERE EXISTS (SELECT 1 FROM measurement "
      "WHERE name = n.id AND machine = (SELECT id FROM machine WHERE name = ?1)) ORDER BY name "
      "LIMIT 10000",
      read, *machine);
}

}  // namespace dripline::storage
