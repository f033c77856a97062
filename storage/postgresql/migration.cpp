#include "storage/postgresql/migration.hpp"

#include "protocol/base/invariant.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage::postgresql {

Result<bool> has_table(sql::Database& database, const std::string& name) {
  const auto known = sql::first_row(
      database,
      "SELECT count(*) FROM information_schema.tables WHERE table_schema = current_schema() AND "
      "table_name = ?1",
      [](const sql::Statement& row) { return row.integer(0) > 0; }, name);
  if (!known) return fail(known.error());
  return known->value_or(false);
}

Result<bool> has_column(sql::Database& database, const std::string& table,
                        const std::string& name) {
  const auto known = sql::first_row(
      database,
      "SELECT count(*) FROM information_schema.columns WHERE table_schema = current_schema() AND "
      "table_name = ?1 AND column_name = ?2",
      [](const sql::Statement& row) { return row.integer(0) > 0; }, table, name);
  if (!known) return fail(known.error());
  return known->value_or(false);
}

namespace {

/// 0: it has no tables.
Result<std::int64_t> version_of(Database& database, std::uint64_t newest) {
  const auto has_version = has_table(database, "schema_version");
  if (!has_version) return fail(has_version.error());
  if (*has_version) {
    const auto version = database.integer("SELECT version FROM schema_version");
    if (!version) return version;
    if (*version >= 1 && static_cast<std::uint64_t>(*version) <= newest) return version;
    return fail(Errc::Unsupported,
                "database {} has schema version {}, this program knows versions up to {}: use a "
                "newer program",
                database.label(), *version, newest);
  }
  const auto tables = database.integer(
      "SELECT count(*) FROM information_schema.tables WHERE table_schema = current_schema()");
  if (!tables || *tables == 0) return tables;
  return fail(Errc::Unsupported, "database {} holds tables but no schema version: not ours",
              database.label());
}

/// Asked before anything is made: what PostgreSQL says of it names neither user nor database.
Result<void> check_right(Database& database) {
  const auto has_right =
      database.integer("SELECT coalesce(has_schema_privilege(current_schema(), 'CREATE'), false)");
  if (!has_right) return fail(has_right.error());
  if (*has_right != 0) return {};
  const auto user = database.text("SELECT current_user::text");
  const auto name = database.text("SELECT current_database()::text");
  if (!user) return fail(user.error());
  if (!name) return fail(name.error());
  return fail(Errc::Denied,
              "database {}: user {} may not make tables in database {}: create it with createdb "
              "--owner={} --encoding=UTF8 --template=template0 {}",
              database.label(), *user, *name, *user, *name);
}

Result<void> apply(Database& database, std::span<const Migration> migrations,
                   const std::string& also) {
  const auto version = version_of(database, migrations.size());
  if (!version) return fail(version.error());
  if (*version == static_cast<std::int64_t>(migrations.size())) return {};
  if (*version == 0) {
    if (auto may = check_right(database); !may) return may;
    auto made = database.execute(
        "CREATE TABLE schema_version (version bigint NOT NULL); INSERT INTO schema_version VALUES "
        "(0)");
    if (!made) return made;
  }
  for (std::size_t i = 0; i < migrations.size(); ++i) {
    invariant(migrations[i].version == i + 1, "migrations are numbered without gaps");
    if (static_cast<std::int64_t>(migrations[i].version) <= *version) continue;
    if (auto done = database.execute(std::string(migrations[i].sql)); !done) {
      return fail(done.error().code, "migration {} of {}: {}", migrations[i].name, database.label(),
                  done.error().what);
    }
  }
  if (!also.empty()) {
    if (auto done = database.execute(also); !done) return done;
  }
  return sql::run(database, "UPDATE schema_version SET version = ?1", migrations.size());
}

}  // namespace

Result<void> migrate(Database& database, std::span<const Migration> migrations,
                     const std::string& also) {
  if (auto begun = database.begin(); !begun) return begun;
  auto done = apply(database, migrations, also);
  if (done) done = database.commit();
  if (!done) database.roll_back();
  return done;
}

}  // namespace dripline::storage::postgresql
