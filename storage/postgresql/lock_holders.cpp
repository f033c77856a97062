#include "storage/postgresql/lock_holders.hpp"

#include <utility>

#include "storage/sql/query.hpp"

namespace dripline::storage::postgresql {
namespace {

/// Sessions with a lock on a table of ours, the oldest transaction first; readers of ours are in
/// no one else. What a user may not see of another one's session is NULL. A copied database has the
/// table numbers of its original, and pg_locks lists both.
constexpr const char* kHolders =
    "SELECT CAST(l.pid AS bigint), coalesce(CAST(a.usename AS text), ''), "
    "coalesce(a.application_name, ''), "
    "coalesce(host(a.client_addr), 'this computer'), string_agg(DISTINCT CAST(c.relname AS text), "
    "', '), "
    "coalesce(CAST(floor(extract(epoch FROM now() - min(a.xact_start))) AS bigint), -1) "
    "FROM pg_locks AS l JOIN pg_class AS c ON c.oid = l.relation AND c.relkind = 'r' "
    "JOIN pg_namespace AS n ON n.oid = c.relnamespace AND n.nspname = current_schema() "
    "LEFT JOIN pg_stat_activity AS a ON a.pid = l.pid "
    "WHERE l.granted AND l.pid <> pg_backend_pid() AND (l.mode <> 'AccessShareLock' OR "
    "a.application_name <> 'dncd') "
    "AND l.database = (SELECT oid FROM pg_database WHERE datname = current_database()) "
    "GROUP BY l.pid, a.usename, a.application_name, a.client_addr "
    "ORDER BY min(a.xact_start) LIMIT 3";

std::string holder_text(const sql::Statement& row) {
  std::string text = fmt::format("process {}", row.integer(0));
  if (!row.text(2).empty()) text += fmt::format(" ({})", row.text(2));
  if (!row.text(1).empty()) text += fmt::format(" of user {}", row.text(1));
  text += fmt::format(" from {} has locked {}", row.text(3), row.text(4));
  if (row.integer(5) >= 0) text += fmt::format(" for {} s", row.integer(5));
  return text;
}

/// A statement that takes long is not one: it waits for no client.
constexpr const char* kFrozen =
    "SELECT CAST(a.pid AS bigint), concat_ws(' ', a.backend_start, a.xact_start, a.query_start, "
    "a.state_change), greatest(a.state_change, a.query_start) < clock_timestamp() - ?1 * interval "
    "'1 millisecond' FROM pg_stat_activity AS a WHERE a.pid IN (SELECT l.pid FROM pg_locks AS l "
    "JOIN pg_class AS c ON c.oid = l.relation AND c.relname = 'store_holder' "
    "JOIN pg_namespace AS n ON n.oid = c.relnamespace AND n.nspname = current_schema() "
    "WHERE l.granted AND l.mode IN ('RowShareLock', 'RowExclusiveLock')) "
    "AND a.datname = current_database() AND a.pid <> pg_backend_pid() "
    "AND a.application_name = 'dncd' AND a.usename = current_user AND a.state <> 'idle' "
    "AND a.wait_event = 'ClientRead' ORDER BY a.pid LIMIT 64";

constexpr const char* kEnd =
    "SELECT CAST(count(pg_terminate_backend(a.pid)) AS bigint) FROM pg_stat_activity AS a WHERE "
    "a.pid = ?1 AND concat_ws(' ', a.backend_start, a.xact_start, a.query_start, a.state_change) = "
    "?2";

}  // namespace

Result<void> FrozenWriters::end(Database& database) {
  struct Session {
    std::int64_t process;
    std::string state;
    bool is_silent;  ///< for the lease, by the database's clock
  };
  const auto asked = std::chrono::steady_clock::now();
  const auto found = sql::all_rows(
      database, kFrozen,
      [](const sql::Statement& row) {
        return Session{row.integer(0), row.text(1), row.integer(2) != 0};
      },
      lease_.count());
  if (!found) return fail(found.error());
  const auto answered = std::chrono::steady_clock::now();
  std::map<std::int64_t, Seen> now;
  for (const auto& [process, state, is_silent] : *found) {
    const auto known = seen_.find(process);
    const bool is_same = known != seen_.end() && known->second.state == state;
    const auto since = is_same ? known->second.since : answered;
    now.emplace(process, Seen{state, since});
    if (!is_silent && asked - since < lease_) continue;
    const auto ended = sql::first_row(
        database, kEnd, [](const sql::Statement& row) { return row.integer(0); }, process, state);
    if (!ended) return fail(ended.error());
  }
  seen_ = std::move(now);
  return {};
}

Error locked_by_others(Database& database, std::chrono::milliseconds waited) {
  const std::string who = [&] {
    const auto holders = sql::all_rows(database, kHolders, holder_text);
    if (!holders || holders->empty()) return std::string("the session that had it is gone");
    std::string all;
    for (const std::string& holder : *holders) all += (all.empty() ? "" : "; ") + holder;
    return all;
  }();
  constexpr double kMsPerSecond = 1000.0;
  return {Errc::Busy,
          fmt::format("database {}: a table was locked by another session for longer than {} s, "
                      "the limit: {}. Let it end its transaction, or end the session",
                      database.label(), static_cast<double>(waited.count()) / kMsPerSecond, who)};
}

}  // namespace dripline::storage::postgresql
