#include "storage/impl/run_endings.hpp"

#include "storage/sqlite/query.hpp"

namespace dripline::storage {

Result<void> apply_beginning(sqlite::Database& database, const RunBeginning& beginning) {
  return sqlite::run(database,
                     "UPDATE run SET state = 'active', started_us = ?2 "
                     "WHERE id = ?1 AND state = 'ordered'",
                     beginning.run, beginning.started);
}

Result<void> apply_ending(sqlite::Database& database, const RunEnding& ending) {
  if (!is_finished(ending.state)) {
    return fail(Errc::Syntax, "run {}: {} is not an end", ending.run, to_string(ending.state));
  }
  return sqlite::run(
      database,
      "UPDATE run SET state = ?2, sent = max(sent, ?3), accepted = max(accepted, ?4), "
      "executed = max(executed, ?5), line = ?6, sequence = ?7, reason = ?8, "
      "executed_content = ?9, content_verified = ?10, ended_us = ?11 "
      "WHERE id = ?1 AND state IN ('ordered', 'active')",
      ending.run, to_string(ending.state), ending.counters.sent, ending.counters.accepted,
      ending.counters.executed, ending.line, ending.sequence, ending.reason,
      ending.executed_content, ending.content_verified, ending.ended);
}

Result<void> add_outputs(sqlite::Database& database, const std::string& run, std::uint64_t count) {
  return sqlite::run(database, "UPDATE run SET outputs = outputs + ?2 WHERE id = ?1", run, count);
}

}  // namespace dripline::storage
