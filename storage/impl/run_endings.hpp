#pragma once

#include "storage/record_store.hpp"
#include "storage/sqlite/database.hpp"

/// How records change runs, inside the transaction that stores the records. Only the runs of the
/// machine that reports are changed.
namespace dripline::storage {

/// Ordered becomes Active. Unknown and other runs stay as they are: a record is never refused for
/// what it reports of a run.
Result<void> apply_beginning(sqlite::Database& database, std::int64_t machine,
                             const RunBeginning& beginning);

/// An unfinished run gets its final state; a finished one keeps the state it has. Counters never go
/// back. Errors: Syntax (the ending's state is none that ends).
Result<void> apply_ending(sqlite::Database& database, std::int64_t machine,
                          const RunEnding& ending);

struct NewOutputs {
  std::string run;
  std::uint64_t count = 0;
};
Result<void> add_outputs(sqlite::Database& database, std::int64_t machine,
                         const NewOutputs& outputs);

}  // namespace dripline::storage
