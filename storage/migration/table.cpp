#include "storage/migration/table.hpp"

#include <algorithm>

#include "protocol/base/invariant.hpp"
#include "storage/impl/sqlite_connections.hpp"
#include "storage/sql/query.hpp"

namespace dripline::migration {
namespace {

bool is_of_search(const std::string& table) {
  return table.starts_with("search_");
}

sql::Kind kind_of(const std::string& type) {
  if (type == "INTEGER" || type == "INT") return sql::Kind::Integer;
  if (type == "REAL") return sql::Kind::Real;
  if (type == "TEXT") return sql::Kind::Text;
  invariant(type == "BLOB", "tables are STRICT");
  return sql::Kind::Blob;
}

Result<std::vector<std::string>> texts(sql::Database& database, const std::string& sql) {
  return sql::all_rows(database, sql, [](const sql::Statement& row) { return row.text(0); });
}

struct NamedColumn {
  Column column;
  std::int64_t key = 0;  ///< its place in the primary key; 0: it is no part of it
};

Result<Table> read_table(sql::Database& database, const std::string& name) {
  Table table;
  table.name = name;
  auto columns = sql::all_rows(
      database, "SELECT name, type, pk FROM pragma_table_info(?1) ORDER BY cid",
      [](const sql::Statement& row) {
        return NamedColumn{{row.text(0), kind_of(row.text(1))}, row.integer(2)};
      },
      name);
  if (!columns) return fail(columns.error());
  for (const NamedColumn& each : *columns) table.columns.push_back(each.column);
  std::erase_if(*columns, [](const NamedColumn& each) { return each.key == 0; });
  std::ranges::sort(*columns, {}, &NamedColumn::key);
  for (const NamedColumn& each : *columns) table.order.push_back(each.column);
  if (table.order.empty()) table.order = table.columns;
  if (columns->size() == 1 && columns->front().column.kind == sql::Kind::Integer)
    table.number = columns->front().column.name;
  auto needs = sql::all_rows(
      database, "SELECT DISTINCT \"table\" FROM pragma_foreign_key_list(?1)",
      [](const sql::Statement& row) { return row.text(0); }, name);
  if (!needs) return fail(needs.error());
  table.needs = *std::move(needs);
  std::erase(table.needs, name);
  return table;
}

/// Whose rows can be written after those of `done`.
bool is_ready(const Table& table, const std::vector<Table>& done) {
  return std::ranges::all_of(table.needs, [&](const std::string& need) {
    return std::ranges::find(done, need, &Table::name) != done.end();
  });
}

std::vector<Table> in_order(std::vector<Table> tables) {
  std::vector<Table> ordered;
  const auto take = [&](auto at) {
    ordered.push_back(std::move(*at));
    tables.erase(at);
  };
  take(std::ranges::find(tables, "identity", &Table::name));
  while (!tables.empty()) {
    const auto next =
        std::ranges::find_if(tables, [&](const Table& table) { return is_ready(table, ordered); });
    invariant(next != tables.end(), "no table refers to itself through others");
    take(next);
  }
  return ordered;
}

}  // namespace

std::string quoted(const std::string& name) {
  return '"' + name + '"';
}

Result<Layout> read_layout() {
  auto database = storage::sqlite::Database::open(":memory:");
  if (!database) return fail(database.error());
  if (auto made = storage::sqlite::migrate(*database, storage::schema()); !made)
    return fail(made.error());
  auto names = texts(*database,
                     "SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT LIKE "
                     "'sqlite_%' AND name NOT LIKE 'search_index_%' ORDER BY name");
  if (!names) return fail(names.error());
  auto never_reuse =
      texts(*database,
            "SELECT name FROM sqlite_schema WHERE type = 'table' AND sql LIKE '%AUTOINCREMENT%'");
  if (!never_reuse) return fail(never_reuse.error());
  auto triggers = texts(*database, "SELECT sql FROM sqlite_schema WHERE type = 'trigger'");
  if (!triggers) return fail(triggers.error());
  std::vector<Table> tables;
  for (const std::string& name : *names) {
    if (is_of_search(name)) continue;
    auto table = read_table(*database, name);
    if (!table) return fail(table.error());
    table->never_reuses = std::ranges::find(*never_reuse, name) != never_reuse->end();
    tables.push_back(*std::move(table));
  }
  return Layout{in_order(std::move(tables)), *std::move(triggers), *std::move(names)};
}

}  // namespace dripline::migration
