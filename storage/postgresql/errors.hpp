#pragma once

#include <string_view>

#include "protocol/base/result.hpp"

struct pg_conn;
struct pg_result;

namespace dripline::storage::postgresql {

/// What PostgreSQL says of a refusal, by its five characters (SQLSTATE).
Errc code_of(std::string_view state);

/// A conflict with another transaction; this one was undone: it may be begun again.
bool asks_to_repeat(std::string_view state);

/// The refusal in `result`, which may be null when the connection was lost. Without the SQL, which
/// is of no use to people; PostgreSQL's own log has it.
Error error_of(pg_conn* connection, pg_result* result);

/// The five characters in `result`; empty: the connection was lost.
std::string_view state_of(pg_result* result);

}  // namespace dripline::storage::postgresql
