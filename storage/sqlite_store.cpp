#include "storage/sqlite_store.hpp"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "storage/impl/all_repositories.hpp"
#include "storage/impl/sqlite_connections.hpp"

namespace dripline::storage {
namespace {

/// While it lives, what runs on the database is interrupted once the time is over or `stop` was
/// requested. The database must outlive it.
class Deadline {
 public:
  Deadline(sqlite::Database& database, std::chrono::milliseconds limit, std::stop_token stop)
      : stop_(std::move(stop)), watch_([this, &database, limit](const std::stop_token& over) {
          watch(database, std::chrono::steady_clock::now() + limit, over);
        }) {}
  bool has_passed() const { return has_passed_; }

 private:
  void watch(sqlite::Database& database, std::chrono::steady_clock::time_point limit,
             const std::stop_token& over) {
    constexpr std::chrono::milliseconds kLook{20};
    std::unique_lock lock(mutex_);
    while (!over.stop_requested()) {
      if (stop_.stop_requested() || std::chrono::steady_clock::now() >= limit) {
        has_passed_ = true;
        database.interrupt();  // again at every look: one between two statements is lost
      }
      changed_.wait_for(lock, over, kLook, [] { return false; });
    }
  }

  const std::stop_token stop_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::atomic<bool> has_passed_ = false;
  std::jthread watch_;  // last: it uses the others
};

}  // namespace

struct SqliteStore::Parts {
  Parts(std::unique_ptr<SqliteConnections> opened, const Clock& clock, const Caches& caches)
      : connections(std::move(opened)), repositories(*connections, clock, caches) {}

  std::unique_ptr<SqliteConnections> connections;
  Repositories repositories;
};

Result<std::unique_ptr<SqliteStore>> SqliteStore::open(const SqliteStoreOptions& options,
                                                       const Clock& clock) {
  auto connections = SqliteConnections::open(options);
  if (!connections) return fail(connections.error());
  return std::unique_ptr<SqliteStore>(new SqliteStore(std::make_unique<Parts>(
      std::move(*connections), clock, Caches{.memory_bytes = options.cache_bytes})));
}

SqliteStore::SqliteStore(std::unique_ptr<Parts> parts)
    : OpenedStore(parts->repositories.store()), parts_(std::move(parts)) {}
SqliteStore::~SqliteStore() = default;

Result<bool> SqliteStore::check(std::chrono::milliseconds limit, const std::stop_token& stop) {
  return parts_->connections->read_file([&](sqlite::Database& database) -> Result<bool> {
    const Deadline deadline(database, limit, stop);
    const auto verdict = database.text("PRAGMA quick_check(1)");
    if (deadline.has_passed()) return false;
    if (!verdict) return fail(verdict.error());
    if (*verdict == "ok") return true;
    return fail(Errc::Corrupt, "database {}: {}", database.file(), *verdict);
  });
}

Result<void> SqliteStore::probe() {
  // Its own value again: the page is written and synchronized all the same, and no table is needed.
  std::int64_t id = 0;
  const auto written = parts_->connections->write([&](sql::Database& database) -> Result<void> {
    const auto now = database.integer("PRAGMA application_id");
    if (!now) return fail(now.error());
    id = *now;
    return database.execute("PRAGMA application_id = " + std::to_string(id));
  });
  if (!written) return written;
  return parts_->connections->read([&](sql::Database& database) -> Result<void> {
    const auto read = database.integer("PRAGMA application_id");
    if (!read) return fail(read.error());
    const auto tables = database.integer("SELECT COUNT(*) FROM sqlite_schema");
    if (!tables) return fail(tables.error());
    if (*read == id) return {};
    return fail(Errc::Corrupt, "the database gives another value than was written");
  });
}

Result<bool> SqliteStore::copy_to(
    const std::filesystem::path& file,
    const std::function<bool(std::uint64_t, std::uint64_t)>& proceed) {
  return parts_->connections->read_file(
      [&](sqlite::Database& database) -> Result<bool> { return database.copy_to(file, proceed); });
}

Result<std::string> SqliteStore::identity() {
  return parts_->connections->read(
      [](sql::Database& database) { return database.text("SELECT id FROM identity"); });
}

Result<std::string> check_copy(const std::filesystem::path& file) {
  auto database = sqlite::Database::open(file, {.access = sqlite::Access::ReadOnly});
  if (!database) return fail(database.error());
  const auto verdict = database->text("PRAGMA quick_check(1)");
  if (!verdict) return fail(verdict.error());
  if (*verdict != "ok") return fail(Errc::Corrupt, "database {}: {}", file.string(), *verdict);
  return database->text("SELECT id FROM identity");
}

}  // namespace dripline::storage
