#pragma once

#include <optional>
#include <string>

#include "storage/program_store.hpp"
#include "storage/sqlite/query.hpp"

/// Programs under other names. Everything runs inside the caller's transaction.
namespace dripline::storage {

/// Errors: Busy (an unfinished run uses the program, named).
Result<void> check_unused(sqlite::Database& database, const std::string& program);

/// Promises of both: storage/program_store.hpp.
Result<Revision> copy_program(sqlite::Database& database, const ProgramMove& move,
                              std::optional<std::uint64_t> number, UtcTime now);
Result<void> rename_program(sqlite::Database& database, const ProgramMove& move, UtcTime now);

}  // namespace dripline::storage
