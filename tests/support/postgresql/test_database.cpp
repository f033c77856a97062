#include "tests/support/postgresql/test_database.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>
#include <atomic>
#include <utility>

#include "storage/postgresql/database.hpp"
#include "storage/postgresql/migration.hpp"

namespace dripline::test {
namespace {

using storage::postgresql::Database;

constexpr int kNotInstalled = 77;  // cluster.sh

/// The folder of the server; empty: PostgreSQL is not installed.
const std::string& cluster() {
  static const std::string kFolder = [] {
    const char* given = ::getenv("DRIPLINE_POSTGRESQL");
    const std::string folder =
        given != nullptr ? given : fmt::format("/tmp/dripline-postgresql-{}", ::getpid());
    const int status = ::system(
        fmt::format("tests/support/postgresql/cluster.sh {} {}", folder, ::getpid()).c_str());
    if (WIFEXITED(status) && WEXITSTATUS(status) == kNotInstalled) return std::string();
    EXPECT_EQ(status, 0) << "tests/support/postgresql/cluster.sh " << folder;
    return folder;
  }();
  return kFolder;
}

std::string url_of(const std::string& folder, const std::string& name) {
  return fmt::format("postgresql://dripline@/{}?host={}", name, folder);
}

void run(const std::string& folder, const std::string& sql) {
  auto database = Database::connect({.url = url_of(folder, "postgres")});
  ASSERT_TRUE(database) << database.error().what;
  const auto done = database->execute(sql);
  ASSERT_TRUE(done) << done.error().what;
}

constexpr const char* kTemplate = "newest_schema";

/// Once for all tests of a server, whichever process comes first.
void make_template(const std::string& folder) {
  static bool is_made = false;
  if (std::exchange(is_made, true)) return;
  auto database = Database::connect(
      {.url = url_of(folder, "dripline"), .lock_timeout = std::chrono::seconds(60)});
  ASSERT_TRUE(database) << database.error().what;
  // The lock lives as long as this connection.
  ASSERT_TRUE(database->execute("SELECT pg_advisory_lock(1)"));
  const auto known = database->integer(
      fmt::format("SELECT count(*) FROM pg_database WHERE datname = '{}'", kTemplate));
  ASSERT_TRUE(known) << known.error().what;
  if (*known > 0) return;
  const std::string making = fmt::format("{}_being_made", kTemplate);
  run(folder, fmt::format("DROP DATABASE IF EXISTS {}", making));
  run(folder, fmt::format("CREATE DATABASE {}", making));
  {
    auto made = Database::connect({.url = url_of(folder, making)});
    ASSERT_TRUE(made) << made.error().what;
    const auto migrated = storage::postgresql::migrate(*made, storage::postgresql::schema());
    ASSERT_TRUE(migrated) << migrated.error().what;
  }
  run(folder, fmt::format("ALTER DATABASE {} RENAME TO {}", making, kTemplate));
}

std::string new_name() {
  static std::atomic<int> made = 0;
  return fmt::format("test_{}_{}", ::getpid(), ++made);
}

}  // namespace

std::unique_ptr<TestDatabase> TestDatabase::make_empty() {
  if (cluster().empty()) return nullptr;
  const std::string name = new_name();
  run(cluster(), "CREATE DATABASE " + name);
  return std::unique_ptr<TestDatabase>(new TestDatabase(cluster(), name));
}

std::unique_ptr<TestDatabase> TestDatabase::make() {
  if (cluster().empty()) return nullptr;
  const std::string name = new_name();
  make_template(cluster());
  run(cluster(), fmt::format("CREATE DATABASE {} TEMPLATE {}", name, kTemplate));
  return std::unique_ptr<TestDatabase>(new TestDatabase(cluster(), name));
}

TestDatabase::TestDatabase(std::string folder, std::string name)
    : folder_(std::move(folder)), name_(std::move(name)), url_(url_of(folder_, name_)) {}

TestDatabase::~TestDatabase() {
  run(folder_, fmt::format("DROP DATABASE {} WITH (FORCE)", name_));
}

}  // namespace dripline::test
