#pragma once

#include "storage/audit_store.hpp"
#include "storage/impl/connections.hpp"

namespace dripline::storage {

/// Inside the caller's transaction.
Result<void> add_audit(sqlite::Database& database, const AuditEntry& entry);

class AuditRepository final : public AuditStore {
 public:
  explicit AuditRepository(Connections& connections) : connections_(connections) {}

  Result<void> add(const AuditEntry& entry) override;
  Result<std::vector<AuditEntry>> list(Page page) override;

 private:
  Connections& connections_;
};

}  // namespace dripline::storage
