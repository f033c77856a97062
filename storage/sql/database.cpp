#include "storage/sql/database.hpp"

#include "storage/sql/query.hpp"

namespace dripline::storage::sql {
namespace {

template <class Value>
Result<Value> the_only(Result<std::optional<Value>> row, const std::string& sql) {
  if (!row) return fail(row.error());
  if (!*row) return fail(Errc::NotFound, "no row from: {}", sql);
  return std::move(**row);
}

}  // namespace

Result<std::int64_t> Database::integer(const std::string& sql) {
  return the_only<std::int64_t>(
      first_row(*this, sql, [](const Statement& row) { return row.integer(0); }), sql);
}

Result<std::string> Database::text(const std::string& sql) {
  return the_only<std::string>(
      first_row(*this, sql, [](const Statement& row) { return row.text(0); }), sql);
}

Result<std::int64_t> id_of(Result<std::optional<std::int64_t>> row, const std::string& sql) {
  return the_only(std::move(row), sql);
}

}  // namespace dripline::storage::sql
