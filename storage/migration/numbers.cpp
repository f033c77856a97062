#include "storage/migration/numbers.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "storage/sql/query.hpp"

namespace dripline::migration {
namespace {

/// The last number that was given in each table.
using Numbers = std::map<std::string, std::int64_t>;

/// Nothing: PostgreSQL does not number this table.
Result<std::optional<std::string>> sequence_of(sql::Database& database, const Table& table) {
  auto row = sql::first_row(
      database, "SELECT pg_get_serial_sequence(?1, ?2)",
      [](const sql::Statement& each) { return each.optional_text(0); }, quoted(table.name),
      table.number);
  if (!row) return fail(row.error());
  return row->value_or(std::nullopt);
}

Result<std::int64_t> last_number(sql::Database& database, const Table& table) {
  const auto used = database.integer(
      fmt::format("SELECT coalesce(max({}), 0) FROM {}", quoted(table.number), quoted(table.name)));
  if (!used) return used;
  Result<std::int64_t> given = 0;
  if (database.engine() == sql::Engine::Postgresql) {
    const auto sequence = sequence_of(database, table);
    if (!sequence) return fail(sequence.error());
    if (*sequence) {
      given = database.integer(
          fmt::format("SELECT CASE WHEN is_called THEN last_value ELSE 0 END FROM {}", **sequence));
    }
  } else if (table.never_reuses) {
    given = database.integer(fmt::format(
        "SELECT coalesce(max(seq), 0) FROM sqlite_sequence WHERE name = '{}'", table.name));
  }
  if (!given) return given;
  return std::max(*used, *given);
}

Result<void> set_number(sql::Database& database, const Table& table, std::int64_t last) {
  if (database.engine() == sql::Engine::Postgresql) {
    const auto sequence = sequence_of(database, table);
    if (!sequence) return fail(sequence.error());
    if (!*sequence) return {};
    const auto set = database.integer(fmt::format("SELECT setval('{}', {}, {})", **sequence,
                                                  std::max<std::int64_t>(last, 1), last > 0));
    return set ? Result<void>() : fail(set.error());
  }
  if (!table.never_reuses) return {};
  return database.execute(
      fmt::format("DELETE FROM sqlite_sequence WHERE name = '{0}'; INSERT INTO sqlite_sequence "
                  "(name, seq) VALUES ('{0}', {1})",
                  table.name, last));
}

}  // namespace

Result<void> carry_numbers(storage::Connections& source, storage::Connections& target,
                           const Layout& layout) {
  const auto numbers = source.read([&](sql::Database& database) -> Result<Numbers> {
    Numbers found;
    for (const Table& table : layout.tables) {
      if (table.number.empty()) continue;
      const auto last = last_number(database, table);
      if (!last) return fail(last.error());
      found[table.name] = *last;
    }
    return found;
  });
  if (!numbers) return fail(numbers.error());
  return target.write([&](sql::Database& database) -> Result<void> {
    for (const Table& table : layout.tables) {
      const auto last = numbers->find(table.name);
      if (last == numbers->end()) continue;
      if (auto set = set_number(database, table, last->second); !set) return set;
    }
    return {};
  });
}

}  // namespace dripline::migration
