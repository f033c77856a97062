#include "storage/sqlite/transaction.hpp"

#include <utility>

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

}  // namespace dripline::storage::sqlite
