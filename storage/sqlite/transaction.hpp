#pragma once

#include <cstdint>
#include <span>
#include <string_view>

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

/// One numbered step of a schema. Texts live as long as the program (they are compiled in).
struct Migration {
  std::uint32_t version = 0;  ///< 1, 2, 3 ... without gaps
  std::string_view name;
  std::string_view sql;
  /// What SQL alone cannot do, after it and in the same transaction; null: nothing.
  Result<void> (*then)(Database& database) = nullptr;
};

/// Brings the file to the newest version: each step in one transaction together with its
/// user_version, so a kill leaves the file at a version, never between two.
/// Errors: Unsupported (the file is of a newer version, or holds someone else's tables), and those
/// of Database.
Result<void> migrate(Database& database, std::span<const Migration> migrations);

}  // namespace dripline::storage::sqlite
