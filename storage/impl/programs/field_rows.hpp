#pragma once

#include "storage/program_fields.hpp"
#include "storage/program_store.hpp"
#include "storage/sqlite/query.hpp"

/// The fields of programs and revisions, inside the caller's transaction.
namespace dripline::storage {

/// Their columns of a program, for `read_fields`.
extern const std::string kFieldColumns;
ProgramFields read_fields(const sqlite::Statement& row, int first_column);

/// Errors: Conflict (no such machine group).
Result<void> check_group(sqlite::Database& database, const FieldChange& change);

/// Sets what differs and adds the audit entry (program.describe) when something does. Errors:
/// NotFound (the revision), Conflict (no such machine group).
Result<void> describe(sqlite::Database& database, const Revision& revision,
                      const FieldChange& change, const Actor& who, UtcTime now);

}  // namespace dripline::storage
