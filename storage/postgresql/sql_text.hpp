#pragma once

#include <string>
#include <string_view>

namespace dripline::storage::postgresql {

/// PostgreSQL's spelling of what the repositories write: ?1 becomes $1, and what only tells
/// SQLite's planner how to go (INDEXED BY name, CROSS JOIN ... ON) is left out. Texts in quotation
/// marks stay as they are.
std::string spelled(std::string_view sql);

/// `INSERT INTO t (...) VALUES (?1, ?2)` for `rows` rows of `parameters` values each, numbered on;
/// empty: it is another kind of statement.
std::string for_many_rows(std::string_view sql, int parameters, int rows);

}  // namespace dripline::storage::postgresql
