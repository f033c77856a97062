#pragma once

#include "storage/programs/program_fields.hpp"
#include "storage/programs/program_store.hpp"
#include "storage/sql/query.hpp"

/// The fields of programs and revisions, inside the caller's transaction.
namespace dripline::storage {

/// Their columns of a program, for `read_fields`.
extern const std::string kFieldColumns;
ProgramFields read_fields(const sql::Statement& row, int first_column);

/// Errors: Conflict (no such machine group).
Result<void> check_group(sql::Database& database, const FieldChange& change);

/// Sets what differs and adds the audit entry (program.describe) when something does. Errors:
/// NotFound (the revision), Conflict (no such machine group).
Result<void> describe(sql::Database& database, const Revision& revision, const FieldChange& change,
                      const Actor& who, UtcTime now);

}  // namespace dripline::storage
