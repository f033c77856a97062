#include "tests/support/postgresql/database_clock.hpp"

#include <gtest/gtest.h>
#include <utility>

#include "storage/postgresql/database.hpp"

namespace dripline::test {
namespace {

void execute(const std::string& url, const std::string& sql) {
  auto database = storage::postgresql::Database::connect({.url = url});
  ASSERT_TRUE(database) << database.error().what;
  const auto done = database->execute(sql);
  ASSERT_TRUE(done) << done.error().what;
}

}  // namespace

/// Functions of a schema that the search path names come before those of PostgreSQL where it names
/// these too, last. The tables of a server stay in the first one.
DatabaseClock::DatabaseClock(std::string url) : url_(std::move(url)) {
  execute(url_,
          "CREATE SCHEMA test_clock;"
          "CREATE TABLE test_clock.shift (by interval NOT NULL);"
          "INSERT INTO test_clock.shift VALUES (interval '0');"
          "CREATE FUNCTION test_clock.clock_timestamp() RETURNS timestamptz LANGUAGE sql VOLATILE "
          "AS 'SELECT pg_catalog.clock_timestamp() + by FROM test_clock.shift';"
          "CREATE FUNCTION test_clock.now() RETURNS timestamptz LANGUAGE sql STABLE AS "
          "'SELECT pg_catalog.now() + by FROM test_clock.shift';"
          "DO 'BEGIN EXECUTE format(''ALTER DATABASE %I SET search_path = public, test_clock, "
          "pg_catalog'', current_database()); END'");
}

void DatabaseClock::shift(std::chrono::seconds by) const {
  execute(url_, "UPDATE test_clock.shift SET by = by + interval '" + std::to_string(by.count()) +
                    " seconds'");
}

}  // namespace dripline::test
