#include "storage/impl/run_endings.hpp"

#include "storage/sqlite/query.hpp"

namespace dripline::storage {

Result<void> apply_beginning(sqlite::Database& database, std::int64_t machine,
                             const RunBeginning& beginning) {
  return sqlite::run(database,
                     "UPDATE run SET state = 'active', started_us = max(?2, created_us) "
                     "WHERE id = ?1 AND machine = ?3 AND state = 'ordered'",
                     beginning.run, beginning.started, machine);
}

Result<void> apply_ending(sqlite::Database& database, std::int64_t machine,
                          const RunEnding& ending) {
  if (!is_finished(ending.state)) {
    return fail(Errc::Syntax, "run {}: {} is not an end", ending.run, to_string(ending.state));
  }
  return sqlite::run(
      database,
      "UPDATE run SET state = ?2, sent = max(sent, ?3), accepted = max(accepted, ?4), "
      "executed = max(executed, ?5), line = ?6, sequence = ?7, reason = ?8, "
      "executed_content = ?9, content_verified = ?10, "
      "ended_us = max(?11, coalesce(started_us, created_us)) "
      "WHERE id = ?1 AND machine = ?12 AND state IN ('ordered', 'active')",
      ending.run, to_string(ending.state), ending.counters.sent, ending.counters.accepted,
      ending.counters.executed, ending.line, ending.sequence, ending.reason,
      ending.executed_content, ending.content_verified, ending.ended, machine);
}

Result<void> add_outputs(sqlite::Database& database, std::int64_t machine,
                         const NewOutputs& outputs) {
  return sqlite::run(database,
                     "UPDATE run SET outputs = outputs + ?2 WHERE id = ?1 AND machine = ?3",
                     outputs.run, outputs.count, machine);
}

}  // namespace dripline::storage
