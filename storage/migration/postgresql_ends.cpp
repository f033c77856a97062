#include "storage/impl/postgresql_connections.hpp"
#include "storage/migration/ends.hpp"
#include "storage/postgresql/migration.hpp"
#include "storage/sql/query.hpp"

namespace dripline::migration {
namespace {

using storage::DatabaseUse;
using storage::PostgresqlConnections;

class PostgresqlSource final : public Source {
 public:
  PostgresqlSource(std::unique_ptr<PostgresqlConnections> connections, bool is_left)
      : connections_(std::move(connections)), is_left_(is_left) {}
  Connections& connections() override { return *connections_; }
  const std::string& label() const override { return connections_->label(); }
  std::uint64_t term() const override { return connections_->term(); }
  bool is_left() const override { return is_left_; }

  Result<void> leave(const std::string& target) override {
    return connections_->write([&](sql::Database& database) -> Result<void> {
      auto made = database.execute("CREATE TABLE store_migrated (target text NOT NULL)");
      if (!made) return made;
      return sql::run(database, "INSERT INTO store_migrated VALUES (?1)", target);
    });
  }

 private:
  std::unique_ptr<PostgresqlConnections> connections_;
  const bool is_left_;
};

class PostgresqlTarget final : public Target {
 public:
  PostgresqlTarget(std::unique_ptr<PostgresqlConnections> connections, bool is_complete)
      : connections_(std::move(connections)), is_complete_(is_complete) {}
  Connections& connections() override { return *connections_; }
  const std::string& label() const override { return connections_->label(); }
  sql::Engine engine() const override { return sql::Engine::Postgresql; }
  bool is_complete() const override { return is_complete_; }

  Result<void> activate(const Layout& layout) override {
    if (is_complete_) return {};
    return connections_->write([&](sql::Database& database) {
      return database.execute(end_sql(sql::Engine::Postgresql, layout));
    });
  }

 private:
  std::unique_ptr<PostgresqlConnections> connections_;
  const bool is_complete_;
};

Result<bool> has_table(Connections& connections, const std::string& name) {
  return connections.read(
      [&](sql::Database& database) { return storage::postgresql::has_table(database, name); });
}

}  // namespace

Result<std::unique_ptr<Source>> leave_postgresql(const storage::PostgresqlStoreOptions& options) {
  auto opened = PostgresqlConnections::open(
      options, {.kind = DatabaseUse::Kind::Leave, .makes_tables = false});
  if (!opened) return fail(opened.error());
  const auto is_left = has_table(**opened, "store_migrated");
  if (!is_left) return fail(is_left.error());
  return std::make_unique<PostgresqlSource>(*std::move(opened), *is_left);
}

Result<std::unique_ptr<Target>> enter_postgresql(const storage::PostgresqlStoreOptions& options,
                                                 const Layout& layout, const std::string& source,
                                                 bool may_begin) {
  auto opened = PostgresqlConnections::open(
      options, {.kind = DatabaseUse::Kind::Enter,
                .begin = begin_sql(sql::Engine::Postgresql, layout, source),
                .source = source,
                .makes_tables = may_begin});
  if (!opened) return fail(opened.error());
  const auto is_begun = has_table(**opened, "store_migration");
  if (!is_begun) return fail(is_begun.error());
  if (!*is_begun) return std::make_unique<PostgresqlTarget>(*std::move(opened), true);
  const auto state = read_state(**opened);
  if (!state) return fail(state.error());
  if (state->source != source) {
    return fail(Errc::Conflict,
                "database {} is the target of a migration of another database that was begun: name "
                "another one, or drop it",
                (*opened)->label());
  }
  return std::make_unique<PostgresqlTarget>(*std::move(opened), false);
}

}  // namespace dripline::migration
