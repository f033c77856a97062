#include "storage/impl/waiting_rows.hpp"

#include "storage/sql/query.hpp"

namespace dripline::storage {

Result<std::vector<WaitingServer>> waiting_servers(sql::Database& database,
                                                   const std::string& except) {
  return sql::all_rows(
      database,
      "SELECT described, CAST(extract(epoch FROM seen) * 1000000 AS bigint) FROM store_standby "
      "WHERE holder <> ?1 AND seen BETWEEN clock_timestamp() - interval '5 seconds' AND "
      "clock_timestamp() + interval '5 seconds' ORDER BY described LIMIT 16",
      [](const sql::Statement& row) {
        return WaitingServer{.described = row.text(0),
                             .seen = UtcTime(std::chrono::microseconds(row.integer(1)))};
      },
      except);
}

Result<void> note_waiting(sql::Database& database, const std::string& holder,
                          const std::string& described) {
  return sql::run(database,
                  "INSERT INTO store_standby (holder, described, seen) VALUES (?1, ?2, "
                  "clock_timestamp()) ON CONFLICT (holder) DO UPDATE SET described = "
                  "excluded.described, seen = excluded.seen",
                  holder, described);
}

Result<void> drop_waiting(sql::Database& database, const std::string& holder) {
  return sql::run(database,
                  "DELETE FROM store_standby WHERE holder = ?1 OR seen < now() - interval '1 day'",
                  holder);
}

}  // namespace dripline::storage
