#pragma once

#include <chrono>

#include "storage/postgresql/database.hpp"

namespace dripline::storage::postgresql {

/// That a table's lock did not come free within `waited`: which session has locked which tables,
/// since when, in words for people. Outside a transaction; what waited has been rolled back.
Error locked_by_others(Database& database, std::chrono::milliseconds waited);

}  // namespace dripline::storage::postgresql
