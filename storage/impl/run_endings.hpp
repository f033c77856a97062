#pragma once

#include "storage/sqlite/database.hpp"
#include "storage/store.hpp"

/// What records do to runs, inside the transaction that stores the records.
namespace dripline::storage {

inline bool is_finished(RunState state) {
  return state != RunState::Ordered && state != RunState::Active;
}

/// Ordered becomes Active. Unknown and other runs stay as they are: a record is never refused for
/// what it says of a run.
Result<void> apply_beginning(sqlite::Database& database, const RunBeginning& beginning);

/// An unfinished run gets its final state; a finished one keeps the state it has. Counters never go
/// back. Errors: Syntax (the ending's state is none that ends).
Result<void> apply_ending(sqlite::Database& database, const RunEnding& ending);

Result<void> add_outputs(sqlite::Database& database, const std::string& run, std::uint64_t count);

}  // namespace dripline::storage
