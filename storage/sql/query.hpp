#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "storage/sql/database.hpp"

/// The shapes nearly every use of a statement has. Errors: those of Database.
namespace dripline::storage::sql {

/// Binds the values to ?1, ?2 ... and runs to the end.
template <class... Values>
Result<void> run(Database& database, const std::string& sql, const Values&... values) {
  auto statement = database.prepare(sql);
  if (!statement) return fail(statement.error());
  return statement->bind(values...).run();
}

/// The first row as `read(const Statement&)` makes it, or nothing.
template <class Read, class... Values>
auto first_row(Database& database, const std::string& sql, Read read, const Values&... values)
    -> Result<std::optional<std::invoke_result_t<Read, const Statement&>>> {
  auto statement = database.prepare(sql);
  if (!statement) return fail(statement.error());
  const auto has_row = statement->bind(values...).step();
  if (!has_row) return fail(has_row.error());
  if (!*has_row) return std::nullopt;
  return read(static_cast<const Statement&>(*statement));
}

/// All rows; the SQL limits their number (LIMIT).
template <class Read, class... Values>
auto all_rows(Database& database, const std::string& sql, Read read, const Values&... values)
    -> Result<std::vector<std::invoke_result_t<Read, const Statement&>>> {
  auto statement = database.prepare(sql);
  if (!statement) return fail(statement.error());
  statement->bind(values...);
  std::vector<std::invoke_result_t<Read, const Statement&>> rows;
  for (;;) {
    const auto has_row = statement->step();
    if (!has_row) return fail(has_row.error());
    if (!*has_row) return rows;
    rows.push_back(read(static_cast<const Statement&>(*statement)));
  }
}

/// Errors: also NotFound (no row).
Result<std::int64_t> id_of(Result<std::optional<std::int64_t>> row, const std::string& sql);

/// An INSERT of one row that ends with `RETURNING` and its id. Errors: also NotFound (it inserted
/// nothing).
template <class... Values>
Result<std::int64_t> insert(Database& database, const std::string& sql, const Values&... values) {
  return id_of(first_row(
                   database, sql, [](const Statement& row) { return row.integer(0); }, values...),
               sql);
}

}  // namespace dripline::storage::sql
