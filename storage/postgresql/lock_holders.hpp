#pragma once

#include <chrono>

#include "storage/postgresql/database.hpp"

namespace dripline::storage::postgresql {

/// That a table's lock did not come free within `waited`: which session has locked which tables,
/// since when, in words for people. Outside a transaction; what waited has been rolled back.
Error locked_by_others(Database& database, std::chrono::milliseconds waited);

/// Disconnects a session of ours that has the place's row locked (schema, store_holder), although
/// its lease is over, and has sent nothing for `lease`: a server that was frozen, or cut off, in
/// the middle of a transaction. What it had not committed is undone.
Result<void> end_frozen_writers(Database& database, std::chrono::milliseconds lease);

}  // namespace dripline::storage::postgresql
