#include "storage/impl/repositories.hpp"

#include "storage/sqlite/query.hpp"

namespace dripline::storage {

Result<void> add_audit(sqlite::Database& database, const AuditEntry& entry) {
  return sqlite::run(database,
                     "INSERT INTO audit (time_us, who, action, subject, detail) "
                     "VALUES (?1, ?2, ?3, ?4, ?5)",
                     entry.time, entry.who, entry.action, entry.subject, entry.detail);
}

Result<void> AuditRepository::add(const AuditEntry& entry) {
  return connections_.write([&](sqlite::Database& database) { return add_audit(database, entry); });
}

Result<std::vector<AuditEntry>> AuditRepository::list(Page page) {
  return connections_.read([&](sqlite::Database& database) {
    return sqlite::all_rows(
        database,
        "SELECT time_us, who, action, subject, detail FROM audit ORDER BY id DESC "
        "LIMIT ?1 OFFSET ?2",
        [](const sqlite::Statement& row) {
          return AuditEntry{row.time(0), row.text(1), row.text(2), row.text(3), row.text(4)};
        },
        page.limit, page.offset);
  });
}

}  // namespace dripline::storage
