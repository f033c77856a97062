#pragma once

#include <cstdint>
#include <string>

#include "protocol/base/result.hpp"
#include "storage/sql/statement.hpp"

namespace dripline::storage::sql {

/// Which SQL is understood where the two differ (README: what both understand).
enum class Engine : std::uint8_t { Sqlite, Postgresql };

/// One connection. One thread at a time; a thread may hand it to another. Errors of everything
/// here: Busy (another connection writes), Corrupt, Io (of a full disk: "disk full"), Conflict (a
/// constraint of the schema); the text holds the engine's code and the SQL.
class Database {
 public:
  Database() = default;
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  virtual ~Database() = default;

  virtual Engine engine() const = 0;
  /// Runs one or several statements that return nothing.
  virtual Result<void> execute(const std::string& sql) = 0;
  /// A prepared statement, kept for the next caller with the same text: so SQL texts are
  /// constants, values are bound. It must be destroyed before the database.
  virtual Result<Statement> prepare(const std::string& sql) = 0;
  /// Rows changed by the statement that ran last.
  virtual std::uint64_t changes() const = 0;

  /// The first column of the only row, for COUNT. Errors: also NotFound (no row).
  Result<std::int64_t> integer(const std::string& sql);
  Result<std::string> text(const std::string& sql);

 protected:
  Database(Database&&) noexcept = default;
  Database& operator=(Database&&) noexcept = default;
};

}  // namespace dripline::storage::sql
