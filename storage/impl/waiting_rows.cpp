#include "storage/impl/waiting_rows.hpp"

#include "storage/sql/query.hpp"

namespace dripline::storage {
namespace {

constexpr const char* kSeenLately =
    "seen BETWEEN clock_timestamp() - interval '5 seconds' AND clock_timestamp() + interval '5 "
    "seconds'";

}  // namespace

Result<std::vector<WaitingServer>> waiting_servers(sql::Database& database) {
  return sql::all_rows(
      database,
      fmt::format("SELECT described, CAST(extract(epoch FROM seen) * 1000000 AS bigint), "
                  "coalesce(gateways, -1) FROM store_standby WHERE {} ORDER BY described LIMIT 16",
                  kSeenLately),
      [](const sql::Statement& row) {
        WaitingServer server{.described = row.text(0),
                             .seen = UtcTime(std::chrono::microseconds(row.integer(1)))};
        if (row.integer(2) >= 0) server.gateways = static_cast<std::uint64_t>(row.integer(2));
        return server;
      });
}

Result<bool> has_other_waiting(sql::Database& database, const std::string& holder) {
  const auto others = sql::first_row(
      database,
      fmt::format("SELECT 1 FROM store_standby WHERE holder <> ?1 AND {} LIMIT 1", kSeenLately),
      [](const sql::Statement&) { return true; }, holder);
  if (!others) return fail(others.error());
  return others->has_value();
}

Result<void> note_waiting(sql::Database& database, const WaitingNote& note) {
  if (!note.has_gateways) {
    return sql::run(database,
                    "INSERT INTO store_standby (holder, described, seen) VALUES (?1, ?2, "
                    "clock_timestamp()) ON CONFLICT (holder) DO UPDATE SET described = "
                    "excluded.described, seen = excluded.seen",
                    note.holder, note.described);
  }
  return sql::run(database,
                  "INSERT INTO store_standby (holder, described, seen, gateways) VALUES (?1, ?2, "
                  "clock_timestamp(), ?3) ON CONFLICT (holder) DO UPDATE SET described = "
                  "excluded.described, seen = excluded.seen, gateways = excluded.gateways",
                  note.holder, note.described, note.gateways);
}

Result<void> drop_waiting(sql::Database& database, const std::string& holder) {
  return sql::run(database,
                  "DELETE FROM store_standby WHERE holder = ?1 OR seen < now() - interval '1 day'",
                  holder);
}

}  // namespace dripline::storage
