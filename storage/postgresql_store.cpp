#include "storage/postgresql_store.hpp"

#include "storage/impl/all_repositories.hpp"
#include "storage/impl/postgresql_connections.hpp"
#include "storage/impl/waiting_rows.hpp"
#include "storage/postgresql/database.hpp"
#include "storage/postgresql/url.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage {

struct PostgresqlStore::Parts {
  Parts(std::unique_ptr<PostgresqlConnections> opened, const Clock& clock, const Caches& caches)
      : connections(std::move(opened)), repositories(*connections, clock, caches) {}

  std::unique_ptr<PostgresqlConnections> connections;
  Repositories repositories;
};

Result<std::unique_ptr<PostgresqlStore>> PostgresqlStore::open(
    const PostgresqlStoreOptions& options, const Clock& clock) {
  auto connections = PostgresqlConnections::open(options);
  if (!connections) return fail(connections.error());
  return std::unique_ptr<PostgresqlStore>(new PostgresqlStore(std::make_unique<Parts>(
      std::move(*connections), clock, Caches{options.cache_bytes, options.content_cache})));
}

PostgresqlStore::PostgresqlStore(std::unique_ptr<Parts> parts)
    : OpenedStore(parts->repositories.store()), parts_(std::move(parts)) {}
PostgresqlStore::~PostgresqlStore() = default;

Result<bool> PostgresqlStore::check(std::chrono::milliseconds, const std::stop_token&) {
  if (const auto known = identity(); !known) return fail(known.error());
  return true;
}

Result<void> PostgresqlStore::probe() {
  if (auto written = parts_->connections->renew(); !written) return written;
  const auto read = identity();
  return read ? Result<void>() : fail(read.error());
}

Result<std::optional<UtcTime>> PostgresqlStore::time() {
  const auto now = parts_->connections->read([](sql::Database& database) {
    return database.integer(fmt::format("SELECT {}", postgresql::kClockMicroseconds));
  });
  if (!now) return fail(now.error());
  return UtcTime(std::chrono::microseconds(*now));
}

Result<bool> PostgresqlStore::copy_to(const std::filesystem::path&,
                                      const std::function<bool(std::uint64_t, std::uint64_t)>&) {
  return fail(Errc::Unsupported,
              "database {}: a PostgreSQL database is backed up by its own tools (pg_basebackup, "
              "pg_dump)",
              parts_->connections->label());
}

Result<std::string> PostgresqlStore::identity() {
  return parts_->connections->read(
      [](sql::Database& database) { return database.text("SELECT id FROM identity"); });
}

std::uint64_t PostgresqlStore::term() const {
  return parts_->connections->term();
}

bool PostgresqlStore::has_place() const {
  return parts_->connections->has_place();
}

void PostgresqlStore::stop_renewing() {
  parts_->connections->stop_renewing();
}

void PostgresqlStore::give_back() {
  parts_->connections->give_back();
}

Result<void> PostgresqlStore::publish(const ServerFacts& facts) {
  return parts_->connections->publish(facts);
}

Result<std::vector<WaitingServer>> PostgresqlStore::waiting() {
  return parts_->connections->read(
      [](sql::Database& database) { return waiting_servers(database); });
}

Result<OwnHandOvers> PostgresqlStore::own_hand_overs() {
  return parts_->connections->read([](sql::Database& database) -> Result<OwnHandOvers> {
    const auto row =
        sql::first_row(database, "SELECT own_hand_overs, has_helped FROM store_holder WHERE id = 1",
                       [](const sql::Statement& found) {
                         return OwnHandOvers{.count = static_cast<std::uint64_t>(found.integer(0)),
                                             .has_helped = found.integer(1) != 0};
                       });
    if (!row) return fail(row.error());
    return row->value_or(OwnHandOvers{});
  });
}

Result<void> PostgresqlStore::note_own_hand_overs(const OwnHandOvers& noted) {
  return parts_->connections->write([&](sql::Database& database) {
    return sql::run(database,
                    "UPDATE store_holder SET own_hand_overs = ?1, has_helped = ?2 WHERE id = 1",
                    static_cast<std::int64_t>(noted.count), noted.has_helped ? 1 : 0);
  });
}

Result<bool> holds_password(const std::string& url) {
  const auto facts = postgresql::read_url(url);
  if (!facts) return fail(facts.error());
  return facts->has_password;
}

}  // namespace dripline::storage
