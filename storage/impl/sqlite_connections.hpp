#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>

#include "protocol/base/descriptor.hpp"
#include "storage/impl/connection_pool.hpp"
#include "storage/impl/connections.hpp"
#include "storage/sqlite/transaction.hpp"
#include "storage/sqlite_store.hpp"

namespace dripline::storage {

/// The file's one writer and its readers. Thread-safe.
class SqliteConnections final : public Connections {
 public:
  /// Locks, creates and migrates the file. Errors: see SqliteStore::open.
  static Result<std::unique_ptr<SqliteConnections>> open(const SqliteStoreOptions& options);

  /// What only a file has. On one consistent picture of it.
  Result<bool> read_file(const std::function<Result<bool>(sqlite::Database&)>& action);

  /// For who gives the file another name after the connections have ended; the last call.
  FileLock keep_lock() { return std::move(lock_); }

 private:
  SqliteConnections(FileLock lock, const SqliteStoreOptions& options)
      : lock_(std::move(lock)),
        file_(options.file),
        writer_(options.wait),
        readers_(options.wait) {}
  Result<void> write_with(const Work& work, Durability durability) override;
  Result<void> read_with(const Work& work) override;
  void note_file();
  Result<void> check_file() const;

  FileLock lock_;  // let go after the connections
  const std::filesystem::path file_;
  std::uint64_t device_ = 0, inode_ = 0;  ///< of the file that is open
  ConnectionPool<sqlite::Database> writer_;
  ConnectionPool<sqlite::Database> readers_;
};

/// The files of storage/schema, compiled in.
std::span<const sqlite::Migration> schema();

}  // namespace dripline::storage
