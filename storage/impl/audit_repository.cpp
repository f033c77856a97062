#include "storage/impl/audit_repository.hpp"

#include <algorithm>

#include "storage/impl/programs/content.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage {
namespace {

using audit::Entry;

const std::string kEntryColumns =
    "audit.id, audit.time_us, audit.who, audit.credential, audit.address, audit.action, "
    "audit.subject, audit.detail, audit.chain ";

/// All that version 9 knew of a run that has ended, without the names that may change later. Texts
/// are hexadecimal digits, so that there is one reading of it.
const std::string kFirstRunFacts =
    "run.number || ' ' || hex(run.id) || ' ' || run.machine || ' ' || run.program || ' ' || "
    "run.revision || ' ' || "
    "hex(run.control) || ' ' || hex(run.state) || ' ' || run.sent || ' ' || run.accepted || ' ' || "
    "run.executed || ' ' || run.line || ' ' || run.sequence || ' ' || hex(run.reason) || ' ' || "
    "CASE WHEN run.executed_content IS NULL THEN 'NULL' ELSE 'X''' || hex(run.executed_content) || "
    "'''' END || ' ' || quote(run.content_verified) || ' ' || "
    "hex(run.author) || ' ' || run.created_us || ' ' || quote(run.started_us) || ' ' || "
    "quote(run.ended_us) || ' ' || quote(run.setup) || ' ' || quote(run.sha256) || ' ' || "
    "hex(run.allowed_as) || ' ' || quote(run.approval) ";
/// What later versions know besides; nothing where a run has none of it, so that the digests of
/// older runs are as they were.
const std::string kRunFacts =
    kFirstRunFacts +
    "|| CASE WHEN run.gateway_setup IS NULL THEN '' ELSE ' setup ' || hex(run.gateway_setup) END "
    "|| CASE WHEN run.is_test = 1 THEN ' test' ELSE '' END || "
    "coalesce((SELECT group_concat("
    "' call ' || hex(name) || ' ' || program || ' ' || revision || ' ' || hex(sha256), '') FROM "
    "(SELECT * FROM run_call WHERE run_call.run = run.number ORDER BY name) AS calls), '') ";
constexpr const char* kRunEnd = "run.end";

Entry read_entry(const sql::Statement& row) {
  return {row.number(0), row.time(1), row.text(2), row.text(3),
          row.text(4),   row.text(5), row.text(6), row.text(7)};
}

/// A row without one is damaged: no chain has this digest.
Digest read_chain(const sql::Statement& row, int column) {
  return row.is_null(column) ? Digest{} : read_digest(row, column);
}

struct ChainEnd {
  std::uint64_t number = 0;
  Digest digest;
};

/// Where the next entry goes.
Result<ChainEnd> chain_end(sql::Database& database) {
  const auto last = sql::first_row(database, "SELECT id, chain FROM audit ORDER BY id DESC LIMIT 1",
                                   [](const sql::Statement& row) {
                                     return ChainEnd{row.number(0), read_chain(row, 1)};
                                   });
  if (!last) return fail(last.error());
  if (*last) return **last;
  const auto identity = database.text("SELECT id FROM identity");
  if (!identity) return fail(identity.error());
  return ChainEnd{0, audit::chain_begin(*identity)};
}

/// As `add_run_end` wrote it.
std::string_view digest_in(std::string_view detail) {
  constexpr std::size_t kHex = 2 * Digest::kSize;
  return detail.size() < kHex ? detail : detail.substr(detail.size() - kHex);
}

ChainedEntry read_chained(const sql::Statement& row) {
  ChainedEntry chained{read_entry(row), read_chain(row, 8), ""};
  if (chained.entry.action != kRunEnd) return chained;
  const std::string& run = chained.entry.subject;
  if (row.is_null(9)) {
    chained.run_fault = fmt::format("run {} was removed", run);
  } else if (sha256(row.text(9)).hex() != digest_in(chained.entry.detail)) {
    chained.run_fault = fmt::format("run {} was changed after its end", run);
  }
  return chained;
}

Result<void> set_chain(sql::Database& database, std::uint64_t number, const Digest& digest) {
  return sql::run(database, "UPDATE audit SET chain = ?2 WHERE id = ?1", number,
                  std::span<const std::byte>(digest.bytes));
}

/// A piece at a time: a trail may be long.
Result<void> chain_entries(sql::Database& database) {
  constexpr std::uint64_t kPiece = 10'000;
  static const std::string kSql =
      "SELECT " + kEntryColumns + "FROM audit WHERE id > ?1 ORDER BY id LIMIT ?2";
  const auto identity = database.text("SELECT id FROM identity");
  if (!identity) return fail(identity.error());
  ChainEnd end{0, audit::chain_begin(*identity)};
  for (;;) {
    const auto entries = sql::all_rows(database, kSql, read_entry, end.number, kPiece);
    if (!entries) return fail(entries.error());
    if (entries->empty()) return {};
    for (const Entry& entry : *entries) {
      end = {entry.number, audit::chain_next(end.digest, audit::line_of(entry))};
      if (auto set = set_chain(database, end.number, end.digest); !set) return set;
    }
  }
}

}  // namespace

Result<void> add_audit(sql::Database& database, const AuditEntry& entry) {
  const auto end = chain_end(database);
  if (!end) return fail(end.error());
  const Entry next{end->number + 1,   entry.time,   entry.who.name, entry.who.credential,
                   entry.who.address, entry.action, entry.subject,  entry.detail};
  const Digest digest = audit::chain_next(end->digest, audit::line_of(next));
  return sql::run(
      database,
      "INSERT INTO audit (id, time_us, who, action, subject, detail, credential, address, chain) "
      "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)",
      next.number, next.time, next.who, next.action, next.subject, next.detail, next.credential,
      next.address, std::span<const std::byte>(digest.bytes));
}

namespace {

std::string select_end(const std::string& facts) {
  return "SELECT run.state, machine.name, program.name, run.revision, run.executed, run.reason, "
         "coalesce(run.ended_us, run.created_us), " +
         facts +
         "FROM run JOIN machine ON machine.id = run.machine JOIN program ON program.id = "
         "run.program "
         "WHERE run.id = ?1 AND run.state NOT IN ('ordered', 'active') AND NOT EXISTS "
         "(SELECT 1 FROM audit WHERE audit.subject = run.id AND audit.action = 'run.end')";
}

Result<void> add_run_end(sql::Database& database, const std::string& sql, const std::string& run) {
  const auto entry = sql::first_row(
      database, sql,
      [&](const sql::Statement& row) {
        const std::string reason = row.text(5);
        return AuditEntry{
            row.time(6),
            {"server", "", ""},
            kRunEnd,
            run,
            fmt::format("{} on {}: {} revision {}, {} blocks executed{}{}; run sha256 {}",
                        row.text(0), row.text(1), row.text(2), row.number(3), row.number(4),
                        reason.empty() ? "" : ": ", reason, sha256(row.text(7)).hex())};
      },
      run);
  if (!entry) return fail(entry.error());
  return *entry ? add_audit(database, **entry) : Result<void>();
}

}  // namespace

Result<void> add_run_end(sql::Database& database, const std::string& run) {
  static const std::string kSql = select_end(kRunFacts);
  return add_run_end(database, kSql, run);
}

Result<void> begin_chain(sql::Database& database) {
  static const std::string kSql = select_end(kFirstRunFacts);
  if (auto chained = chain_entries(database); !chained) return chained;
  const auto ended = sql::all_rows(
      database, "SELECT id FROM run WHERE state NOT IN ('ordered', 'active') ORDER BY number",
      [](const sql::Statement& row) { return row.text(0); });
  if (!ended) return fail(ended.error());
  for (const auto& run : *ended) {
    if (auto added = add_run_end(database, kSql, run); !added) return added;
  }
  return {};
}

Result<void> AuditRepository::add(const AuditEntry& entry) {
  return connections_.write([&](sql::Database& database) { return add_audit(database, entry); });
}

Result<std::vector<AuditEntry>> AuditRepository::list(Page page) {
  return connections_.read([&](sql::Database& database) {
    return sql::all_rows(
        database,
        "SELECT time_us, who, action, subject, detail, credential, address FROM audit "
        "ORDER BY id DESC "
        "LIMIT ?1 OFFSET ?2",
        [](const sql::Statement& row) {
          return AuditEntry{row.time(0),
                            {row.text(1), row.text(5), row.text(6)},
                            row.text(2),
                            row.text(3),
                            row.text(4)};
        },
        page.limit, page.offset);
  });
}

Result<std::vector<ChainedEntry>> AuditRepository::chained(std::uint64_t after,
                                                           std::uint64_t limit) {
  static const std::string kSql =
      "SELECT " + kEntryColumns + ", " + kRunFacts +
      "FROM audit LEFT JOIN run ON audit.action = 'run.end' AND run.id = audit.subject "
      "WHERE audit.id > ?1 ORDER BY audit.id LIMIT ?2";
  return connections_.read([&](sql::Database& database) {
    return sql::all_rows(database, kSql, read_chained, after, limit);
  });
}

Result<std::vector<audit::Checkpoint>> AuditRepository::checkpoints(std::uint64_t after,
                                                                    std::uint64_t limit) {
  return connections_.read([&](sql::Database& database) {
    return sql::all_rows(
        database,
        "SELECT number, entry, time_us, chain, signature FROM audit_checkpoint WHERE number > ?1 "
        "ORDER BY number LIMIT ?2",
        [](const sql::Statement& row) {
          audit::Checkpoint checkpoint{
              row.number(0), row.number(1), row.time(2), read_chain(row, 3), {}};
          const auto signature = row.blob(4);
          if (signature.size() == Signature::kSize)
            std::ranges::copy(signature, checkpoint.signature.bytes.begin());
          return checkpoint;
        },
        after, limit);
  });
}

Result<void> AuditRepository::add_checkpoint(const audit::Checkpoint& checkpoint) {
  return connections_.write([&](sql::Database& database) {
    return sql::run(database,
                    "INSERT INTO audit_checkpoint (number, entry, time_us, chain, signature) "
                    "VALUES (?1, ?2, ?3, ?4, ?5)",
                    checkpoint.number, checkpoint.entry, checkpoint.time,
                    std::span<const std::byte>(checkpoint.digest.bytes),
                    std::span<const std::byte>(checkpoint.signature.bytes));
  });
}

Result<std::optional<ChainedEntry>> AuditRepository::run_end(const std::string& run) {
  static const std::string kSql =
      "SELECT " + kEntryColumns + ", " + kRunFacts +
      "FROM audit LEFT JOIN run ON run.id = audit.subject "
      "WHERE audit.subject = ?1 AND audit.action = 'run.end' ORDER BY audit.id LIMIT 1";
  return connections_.read(
      [&](sql::Database& database) { return sql::first_row(database, kSql, read_chained, run); });
}

Result<std::optional<std::string>> AuditRepository::run_without_end() {
  return connections_.read([&](sql::Database& database) {
    return sql::first_row(
        database,
        "SELECT id FROM run WHERE state NOT IN ('ordered', 'active') AND NOT EXISTS (SELECT 1 FROM "
        "audit WHERE audit.subject = run.id AND audit.action = 'run.end') ORDER BY number LIMIT 1",
        [](const sql::Statement& row) { return row.text(0); });
  });
}

}  // namespace dripline::storage
