#pragma once

#include "storage/sqlite/database.hpp"

namespace dripline::storage::sqlite {

/// BEGIN IMMEDIATE: the right to write is taken at once, so a transaction never fails midway
/// because of another writer. Rolls back unless committed. The database must outlive it.
class Transaction {
 public:
  /// Errors: Busy (another connection writes, longer than the busy timeout), Io.
  static Result<Transaction> begin(Database& database);
  Transaction(Transaction&& other) noexcept;
  Transaction& operator=(Transaction&&) = delete;
  ~Transaction();

  /// On an error nothing was changed.
  Result<void> commit();

 private:
  explicit Transaction(Database& database) : database_(&database) {}
  Database* database_;  ///< null when committed or moved from
};

/// The same picture of the file for several reads. Ends with its scope.
class Snapshot {
 public:
  static Result<Snapshot> begin(Database& database);
  Snapshot(Snapshot&& other) noexcept;
  Snapshot& operator=(Snapshot&&) = delete;
  ~Snapshot();

 private:
  explicit Snapshot(Database& database) : database_(&database) {}
  Database* database_;
};

}  // namespace dripline::storage::sqlite
