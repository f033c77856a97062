#include "storage/migration/target_state.hpp"

#include "storage/sql/query.hpp"

namespace dripline::migration {
namespace {

constexpr const char* kMakeTables =
    "CREATE TABLE store_migration (source text NOT NULL, is_verified bigint NOT NULL);"
    "CREATE TABLE store_migration_table (name text PRIMARY KEY, rows bigint NOT NULL, is_whole "
    "bigint NOT NULL, sha256 text NOT NULL);";

/// All triggers of ours, not those that are PostgreSQL's foreign keys.
std::string alter_triggers(const char* verb) {
  return fmt::format(
      "DO $$ DECLARE owner regclass; BEGIN FOR owner IN SELECT DISTINCT tgrelid::regclass FROM "
      "pg_trigger WHERE NOT tgisinternal LOOP EXECUTE format('ALTER TABLE %s {} TRIGGER USER', "
      "owner); END LOOP; END $$;",
      verb);
}

std::string drop_triggers(const Layout& layout) {
  std::string sql;
  for (const std::string& trigger : layout.triggers) {
    constexpr std::string_view kHead = "CREATE TRIGGER ";
    const auto end = trigger.find_first_of(" \n", kHead.size());
    sql += "DROP TRIGGER " + trigger.substr(kHead.size(), end - kHead.size()) + ";";
  }
  return sql;
}

/// Each table before those that its rows refer to.
std::string delete_rows(const Layout& layout) {
  std::string sql;
  for (auto table = layout.tables.rbegin(); table != layout.tables.rend(); ++table)
    sql += fmt::format("DELETE FROM {};", quoted(table->name));
  return sql;
}

}  // namespace

std::string begin_sql(sql::Engine engine, const Layout& layout, const std::string& source) {
  std::string sql =
      engine == sql::Engine::Postgresql ? alter_triggers("DISABLE") : drop_triggers(layout);
  return sql + delete_rows(layout) + kMakeTables +
         fmt::format("INSERT INTO store_migration VALUES ('{}', 0);", source);
}

std::string end_sql(sql::Engine engine, const Layout& layout) {
  std::string sql =
      "DELETE FROM search_due; INSERT INTO search_due (program, version) SELECT id, 1 FROM program;"
      "DROP TABLE store_migration; DROP TABLE store_migration_table;";
  if (engine == sql::Engine::Postgresql) return sql + alter_triggers("ENABLE");
  for (const std::string& trigger : layout.triggers) sql += trigger + ";\n";
  return sql;
}

std::string restart_sql(sql::Engine engine, const Layout& layout) {
  std::string sql =
      "DELETE FROM store_migration_table; UPDATE store_migration SET is_verified = 0;";
  if (engine == sql::Engine::Postgresql) {
    std::string names;
    for (const std::string& name : layout.names)
      names += (names.empty() ? "" : ", ") + quoted(name);
    return sql + "TRUNCATE " + names + ";";
  }
  return sql + delete_rows(layout);
}

Result<TargetState> read_state(Connections& target) {
  return target.read([](sql::Database& database) -> Result<TargetState> {
    const auto source = database.text("SELECT source FROM store_migration");
    if (!source) return fail(source.error());
    const auto is_verified = database.integer("SELECT is_verified FROM store_migration");
    if (!is_verified) return fail(is_verified.error());
    return TargetState{*source, *is_verified != 0};
  });
}

Result<TableState> table_state(Connections& target, const Table& table) {
  return target.read([&](sql::Database& database) -> Result<TableState> {
    const auto state = sql::first_row(
        database, "SELECT rows, is_whole FROM store_migration_table WHERE name = ?1",
        [](const sql::Statement& row) {
          return TableState{row.number(0), row.integer(1) != 0};
        },
        table.name);
    if (!state) return fail(state.error());
    return state->value_or(TableState{});
  });
}

Result<void> save_table_state(sql::Database& target, const Table& table, const TableState& state) {
  return sql::run(
      target,
      "INSERT INTO store_migration_table (name, rows, is_whole, sha256) VALUES (?1, ?2, "
      "?3, '') ON CONFLICT (name) DO UPDATE SET rows = ?2, is_whole = ?3",
      table.name, state.rows, state.is_whole ? 1 : 0);
}

Result<void> save_verified(Connections& target, const std::vector<VerifiedTable>& tables) {
  return target.write([&](sql::Database& database) -> Result<void> {
    for (const VerifiedTable& table : tables) {
      auto saved =
          sql::run(database, "UPDATE store_migration_table SET sha256 = ?2 WHERE name = ?1",
                   table.name, table.digest.sha256.hex());
      if (!saved) return saved;
    }
    return database.execute("UPDATE store_migration SET is_verified = 1");
  });
}

Result<std::vector<VerifiedTable>> read_verified(Connections& target) {
  return target.read([](sql::Database& database) {
    return sql::all_rows(
        database, "SELECT name, rows, sha256 FROM store_migration_table ORDER BY name",
        [](const sql::Statement& row) {
          return VerifiedTable{row.text(0),
                               {row.number(1), parse_digest(row.text(2)).value_or(Digest{})}};
        });
  });
}

}  // namespace dripline::migration
