#pragma once

#include "storage/impl/connections.hpp"

namespace dripline::storage {

/// Inside the caller's transaction.
Result<void> add_audit(sqlite::Database& database, const AuditEntry& entry);

/// Promises: storage/store.hpp. Thread-safe.
class AuditRepository {
 public:
  explicit AuditRepository(Connections& connections) : connections_(connections) {}

  Result<void> add(const AuditEntry& entry);
  Result<std::vector<AuditEntry>> all(Page page);

 private:
  Connections& connections_;
};

}  // namespace dripline::storage
