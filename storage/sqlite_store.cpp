#include "storage/sqlite_store.hpp"

#include "storage/impl/program_repository.hpp"
#include "storage/impl/repositories.hpp"
#include "storage/impl/upload_repository.hpp"
#include "storage/sqlite/deadline.hpp"

namespace dripline::storage {

struct SqliteStore::Repositories {
  Repositories(std::unique_ptr<Connections> opened, const Clock& clock, std::uint64_t cache_bytes)
      : connections(std::move(opened)),
        programs(*connections, clock, cache_bytes),
        uploads(*connections, clock),
        machines(*connections),
        runs(*connections, clock),
        records(*connections, clock),
        ports(*connections),
        setups(*connections, clock),
        audit(*connections) {}

  std::unique_ptr<Connections> connections;
  ProgramRepository programs;
  UploadRepository uploads;
  MachineRepository machines;
  RunRepository runs;
  RecordRepository records;
  PortRepository ports;
  SetupRepository setups;
  AuditRepository audit;
};

Result<std::unique_ptr<SqliteStore>> SqliteStore::open(const SqliteStoreOptions& options,
                                                       const Clock& clock) {
  auto connections = Connections::open(options);
  if (!connections) return fail(connections.error());
  return std::unique_ptr<SqliteStore>(new SqliteStore(
      std::make_unique<Repositories>(std::move(*connections), clock, options.cache_bytes)));
}

SqliteStore::SqliteStore(std::unique_ptr<Repositories> repositories)
    : Store{repositories->programs, repositories->uploads, repositories->machines,
            repositories->runs,     repositories->records, repositories->ports,
            repositories->setups,   repositories->audit},
      repositories_(std::move(repositories)) {}
SqliteStore::~SqliteStore() = default;

Result<bool> SqliteStore::check(std::chrono::milliseconds limit, const std::stop_token& stop) {
  return repositories_->connections->read([&](sqlite::Database& database) -> Result<bool> {
    const sqlite::Deadline deadline(database, limit, stop);
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
  const auto written =
      repositories_->connections->write([&](sqlite::Database& database) -> Result<void> {
        const auto now = database.integer("PRAGMA application_id");
        if (!now) return fail(now.error());
        id = *now;
        return database.execute("PRAGMA application_id = " + std::to_string(id));
      });
  if (!written) return written;
  return repositories_->connections->read([&](sqlite::Database& database) -> Result<void> {
    const auto read = database.integer("PRAGMA application_id");
    if (!read) return fail(read.error());
    const auto tables = database.integer("SELECT COUNT(*) FROM sqlite_schema");
    if (!tables) return fail(tables.error());
    if (*read == id) return {};
    return fail(Errc::Corrupt, "database {} gives another value than was written", database.file());
  });
}

Result<std::string> SqliteStore::identity() {
  return repositories_->connections->read(
      [](sqlite::Database& database) { return database.text("SELECT id FROM identity"); });
}

}  // namespace dripline::storage
