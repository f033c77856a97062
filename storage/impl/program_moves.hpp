#pragma once

#include <optional>
#include <string>

#include "storage/sqlite/query.hpp"
#include "storage/store.hpp"

/// Programs under other names. Everything runs inside the caller's transaction.
namespace dripline::storage {

/// Errors: Busy (an unfinished run uses the program, named).
Result<void> check_unused(sqlite::Database& database, const std::string& program);

/// Promises of both: storage/store.hpp.
Result<Revision> copy_program(sqlite::Database& database, const ProgramMove& move,
                              std::optional<std::uint64_t> number, UtcTime now);
Result<void> rename_program(sqlite::Database& database, const ProgramMove& move, UtcTime now);

}  // namespace dripline::storage
