#pragma once

#include <condition_variable>
#include <mutex>
#include <span>
#include <type_traits>
#include <vector>

#include "protocol/base/descriptor.hpp"
#include "storage/sqlite/transaction.hpp"
#include "storage/sqlite_store.hpp"

namespace dripline::storage {

/// Hands out connections, each to one thread at a time. Thread-safe.
class ConnectionPool {
 public:
  explicit ConnectionPool(std::chrono::milliseconds wait) : wait_(wait) {}
  void add(sqlite::Database connection) { free_.push_back(std::move(connection)); }

  /// Runs `action(database)` with a connection of its own. Errors: Busy (none came free in time),
  /// and the action's.
  template <class Action>
  auto with(Action action) -> std::invoke_result_t<Action, sqlite::Database&> {
    auto taken = take();
    if (!taken) return fail(taken.error());
    Lease lease{*this, std::move(*taken)};
    return action(lease.database);
  }

 private:
  struct Lease {
    ConnectionPool& pool;
    sqlite::Database database;
    ~Lease() { pool.give_back(std::move(database)); }
  };
  Result<sqlite::Database> take();
  void give_back(sqlite::Database connection);

  const std::chrono::milliseconds wait_;
  std::mutex mutex_;
  std::condition_variable freed_;
  std::vector<sqlite::Database> free_;
};

/// The file's one writer and its readers. Thread-safe.
class Connections {
 public:
  /// Locks, creates and migrates the file. Errors: see SqliteStore::open.
  static Result<std::unique_ptr<Connections>> open(const SqliteStoreOptions& options);

  /// `action(database)` in one transaction, committed when it succeeds, undone when it fails.
  /// Normal: not lost by a kill of the process, but maybe by a power cut.
  template <class Action>
  auto write(Action action, sqlite::Synchronous synchronous = sqlite::Synchronous::Full)
      -> std::invoke_result_t<Action, sqlite::Database&> {
    using Outcome = std::invoke_result_t<Action, sqlite::Database&>;
    return writer_.with([&](sqlite::Database& database) -> Outcome {
      if (auto there = check_file(); !there) return fail(there.error());
      if (auto set = database.set_synchronous(synchronous); !set) return fail(set.error());
      auto transaction = sqlite::Transaction::begin(database);
      if (!transaction) return fail(transaction.error());
      Outcome outcome = action(database);
      if (!outcome) return outcome;
      if (auto committed = transaction->commit(); !committed) return fail(committed.error());
      return outcome;
    });
  }

  /// `action(database)` on one consistent picture of the file.
  template <class Action>
  auto read(Action action) -> std::invoke_result_t<Action, sqlite::Database&> {
    using Outcome = std::invoke_result_t<Action, sqlite::Database&>;
    return readers_.with([&](sqlite::Database& database) -> Outcome {
      auto snapshot = sqlite::Snapshot::begin(database);
      if (!snapshot) return fail(snapshot.error());
      return action(database);
    });
  }

 private:
  Connections(FileLock lock, const SqliteStoreOptions& options)
      : lock_(std::move(lock)),
        file_(options.file),
        writer_(options.wait),
        readers_(options.wait) {}
  void note_file();
  Result<void> check_file() const;

  FileLock lock_;  // let go after the connections
  const std::filesystem::path file_;
  std::uint64_t device_ = 0, inode_ = 0;  ///< of the file that is open
  ConnectionPool writer_;
  ConnectionPool readers_;
};

/// The files of storage/schema, compiled in.
std::span<const sqlite::Migration> schema();

}  // namespace dripline::storage
