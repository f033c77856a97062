#include "storage/sqlite/transaction.hpp"

#include <utility>

#include "protocol/base/invariant.hpp"

namespace dripline::storage::sqlite {

namespace {

/// Some errors (a full disk among them) have rolled back already: then there is nothing to undo.
void roll_back(Database& database) {
  if (!database.in_transaction()) return;
  // This fails only when SQLite has rolled back by itself in the meantime.
  static_cast<void>(database.execute("ROLLBACK"));
}

}  // namespace

Result<Transaction> Transaction::begin(Database& database) {
  if (auto begun = database.execute("BEGIN IMMEDIATE"); !begun) return fail(begun.error());
  return Transaction(database);
}

Transaction::Transaction(Transaction&& other) noexcept
    : database_(std::exchange(other.database_, nullptr)) {}

Transaction::~Transaction() {
  if (database_ != nullptr) roll_back(*database_);
}

Result<void> Transaction::commit() {
  Database* database = std::exchange(database_, nullptr);
  auto committed = database->execute("COMMIT");
  if (!committed) roll_back(*database);
  return committed;
}

Result<Snapshot> Snapshot::begin(Database& database) {
  if (auto begun = database.execute("BEGIN"); !begun) return fail(begun.error());
  return Snapshot(database);
}

Snapshot::Snapshot(Snapshot&& other) noexcept
    : database_(std::exchange(other.database_, nullptr)) {}

Snapshot::~Snapshot() {
  if (database_ != nullptr) roll_back(*database_);
}

namespace {

Result<void> check_origin(Database& database, std::int64_t version, std::uint64_t newest) {
  if (version < 0 || static_cast<std::uint64_t>(version) > newest) {
    return fail(Errc::Unsupported,
                "database {} has schema version {}, this program knows versions up to {}: use a "
                "newer program",
                database.file(), version, newest);
  }
  if (version > 0) return {};
  const auto tables = database.integer("SELECT count(*) FROM sqlite_schema");
  if (!tables) return fail(tables.error());
  if (*tables > 0) {
    return fail(Errc::Unsupported, "database {} holds tables but no schema version: not ours",
                database.file());
  }
  return {};
}

Result<void> apply(Database& database, const Migration& migration) {
  auto transaction = Transaction::begin(database);
  if (!transaction) return fail(transaction.error());
  if (auto done = database.execute(std::string(migration.sql)); !done) {
    return fail(done.error().code, "migration {} of {}: {}", migration.name, database.file(),
                done.error().what);
  }
  if (migration.then != nullptr) {
    if (auto done = migration.then(database); !done) {
      return fail(done.error().code, "migration {} of {}: {}", migration.name, database.file(),
                  done.error().what);
    }
  }
  if (auto done = database.execute(fmt::format("PRAGMA user_version = {}", migration.version));
      !done) {
    return done;
  }
  return transaction->commit();
}

}  // namespace

Result<void> migrate(Database& database, std::span<const Migration> migrations) {
  const auto version = database.integer("PRAGMA user_version");
  if (!version) return fail(version.error());
  if (auto ours = check_origin(database, *version, migrations.size()); !ours) return ours;
  for (std::size_t i = 0; i < migrations.size(); ++i) {
    invariant(migrations[i].version == i + 1, "migrations are numbered without gaps");
    if (static_cast<std::int64_t>(migrations[i].version) <= *version) continue;
    if (auto done = apply(database, migrations[i]); !done) return done;
  }
  return {};
}

}  // namespace dripline::storage::sqlite
