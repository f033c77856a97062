#pragma once

#include <memory>
#include <string>

#include "storage/postgresql/database.hpp"
#include "storage/sql/query.hpp"
#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {

/// A store in PostgreSQL, and others that want its database too.
class PostgresqlStoreTest : public StoreTest {
 protected:
  PostgresqlStoreTest() : StoreTest(sql::Engine::Postgresql) {}

  Result<std::unique_ptr<PostgresqlStore>> open_another(const std::string& holder = "") {
    return open_waiting(holder, std::chrono::milliseconds(0));
  }
  Result<std::unique_ptr<PostgresqlStore>> open_waiting(
      const std::string& holder, std::chrono::milliseconds wait,
      std::chrono::milliseconds lease = std::chrono::seconds(3)) {
    return PostgresqlStore::open({.url = database_->url(),
                                  .holder = holder,
                                  .described = "dncd 7 on srv-2",
                                  .lease = lease,
                                  .wait_for_holder = wait},
                                 clock_);
  }
  /// As a server that has watched this row until its lease was over.
  Result<std::unique_ptr<PostgresqlStore>> open_ended(const LeaseRow& row,
                                                      const std::string& holder = "") {
    return PostgresqlStore::open({.url = database_->url(),
                                  .holder = holder,
                                  .described = "dncd 7 on srv-2",
                                  .wait_for_holder = std::chrono::milliseconds(0),
                                  .ended = row},
                                 clock_);
  }
  LeaseRow row() const {
    auto database = postgresql::Database::connect({.url = database_->url()});
    EXPECT_TRUE(database) << database.error().what;
    const auto found = sql::first_row(
        *database,
        "SELECT holder, term, CAST(extract(epoch FROM until) * 1000000 AS bigint) FROM "
        "store_holder",
        [](const sql::Statement& at) {
          return LeaseRow{at.text(0), static_cast<std::uint64_t>(at.integer(1)), at.integer(2)};
        });
    return found && *found ? **found : LeaseRow{};
  }
  /// Its lease is not renewed while the test lasts, as of a server that was killed.
  Result<std::unique_ptr<PostgresqlStore>> open_as_if_killed(const std::string& holder) {
    return open_waiting(holder, std::chrono::milliseconds(0), std::chrono::minutes(10));
  }
  void lose_connections() {
    change(
        "SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE datname = "
        "current_database() AND pid <> pg_backend_pid()");
  }
};

}  // namespace dripline::storage
