#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "storage/migration/table.hpp"

namespace dripline::migration {

using Value =
    std::variant<std::monostate, std::int64_t, double, std::string, std::vector<std::byte>>;
using Row = std::vector<Value>;

/// The rows of one table in the order of its key, by bytes in both engines. In a transaction that
/// sees one picture; the database must outlive it, and one reader at a time reads from it.
class RowReader {
 public:
  /// Passes over the first `passed` rows.
  static Result<RowReader> begin(sql::Database& database, const Table& table,
                                 std::uint64_t passed = 0);
  /// Nothing: there are no more.
  Result<std::optional<Row>> next();

 private:
  RowReader(sql::Database& database, const Table& table, sql::Statement statement, bool is_fetched)
      : database_(&database),
        table_(&table),
        statement_(std::move(statement)),
        is_fetched_(is_fetched) {}
  Row row() const;

  sql::Database* database_;
  const Table* table_;
  sql::Statement statement_;
  bool is_fetched_;            ///< in parts, each an execution of the statement
  std::uint64_t in_part_ = 0;  ///< rows of the part that were read
};

/// Bytes of a row, of both engines the same: the kind of each value, its length, the value. A zero
/// has no sign: SQLite does not keep it.
void append_canonical(std::string& bytes, const Row& row);

/// Bytes that a row takes in memory, about.
std::uint64_t weight_of(const Row& row);

/// Inserts into all columns of a table, many after another. The row's bytes must live until the
/// next call.
class RowWriter {
 public:
  static Result<RowWriter> begin(sql::Database& database, const Table& table);
  Result<void> write(const Row& row);

 private:
  RowWriter(const Table& table, sql::Statement statement)
      : table_(&table), statement_(std::move(statement)) {}
  const Table* table_;
  sql::Statement statement_;
};

}  // namespace dripline::migration
