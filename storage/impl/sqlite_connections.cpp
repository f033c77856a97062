#include "storage/impl/sqlite_connections.hpp"

#include <sys/stat.h>

#include "protocol/base/durable_file.hpp"

namespace dripline::storage {
namespace {

sqlite::OpenOptions connection_options(const SqliteStoreOptions& options, sqlite::Access access) {
  sqlite::OpenOptions connection;
  connection.access = access;
  connection.busy_timeout = options.wait;
  connection.max_bytes = options.max_bytes;
  connection.cache_bytes = access == sqlite::Access::ReadWrite ? 8 << 20 : 1 << 20;
  // Big enough that a page written by several pieces of an upload goes into the file once.
  connection.checkpoint_bytes = 16 << 20;
  return connection;
}

}  // namespace

Result<void> SqliteConnections::write_with(const Work& work, Durability durability) {
  return writer_.with([&](sqlite::Database& database) -> Result<void> {
    if (auto there = check_file(); !there) return there;
    const auto synchronous =
        durability == Durability::Full ? sqlite::Synchronous::Full : sqlite::Synchronous::Normal;
    if (auto set = database.set_synchronous(synchronous); !set) return set;
    auto transaction = sqlite::Transaction::begin(database);
    if (!transaction) return fail(transaction.error());
    if (auto done = work(database); !done) return done;
    return transaction->commit();
  });
}

Result<void> SqliteConnections::read_with(const Work& work) {
  return readers_.with([&](sqlite::Database& database) -> Result<void> {
    auto snapshot = sqlite::Snapshot::begin(database);
    if (!snapshot) return fail(snapshot.error());
    return work(database);
  });
}

Result<bool> SqliteConnections::read_file(
    const std::function<Result<bool>(sqlite::Database&)>& action) {
  return readers_.with([&](sqlite::Database& database) -> Result<bool> {
    auto snapshot = sqlite::Snapshot::begin(database);
    if (!snapshot) return fail(snapshot.error());
    return action(database);
  });
}

void SqliteConnections::note_file() {
  struct stat facts {};
  if (::stat(file_.c_str(), &facts) != 0) return;
  device_ = facts.st_dev;
  inode_ = facts.st_ino;
}

/// A file that was removed or replaced accepts what is written until it is closed, and then all of
/// it is lost: nothing may be acknowledged there. Errors: Io.
Result<void> SqliteConnections::check_file() const {
  struct stat facts {};
  if (::stat(file_.c_str(), &facts) == 0 && facts.st_dev == device_ && facts.st_ino == inode_)
    return {};
  return fail(Errc::Io,
              "database {} was moved, removed or replaced while it is in use: nothing is stored "
              "until it is back in its place, or the server is started again on a restored one",
              file_.string());
}

Result<std::unique_ptr<SqliteConnections>> SqliteConnections::open(
    const SqliteStoreOptions& options) {
  auto lock = FileLock::acquire(options.file.string() + ".lock", options.file.string());
  if (!lock) return fail(lock.error());
  std::unique_ptr<SqliteConnections> connections(new SqliteConnections(std::move(*lock), options));

  auto writer =
      sqlite::Database::open(options.file, connection_options(options, sqlite::Access::ReadWrite));
  if (!writer) return fail(writer.error());
  if (auto migrated = sqlite::migrate(*writer, schema()); !migrated) return fail(migrated.error());
  connections->writer_.add(std::move(*writer));
  connections->note_file();

  for (std::size_t i = 0; i < std::max<std::size_t>(1, options.readers); ++i) {
    auto reader =
        sqlite::Database::open(options.file, connection_options(options, sqlite::Access::ReadOnly));
    if (!reader) return fail(reader.error());
    connections->readers_.add(std::move(*reader));
  }
  // A new file's name is on disk only when its folder is; some file systems refuse it.
  sync_folder(std::filesystem::absolute(options.file).parent_path());
  return connections;
}

}  // namespace dripline::storage
