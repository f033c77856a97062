#pragma once

#include "storage/audit_store.hpp"
#include "storage/impl/connections.hpp"
#include "storage/sql/database.hpp"

namespace dripline::storage {

/// The next entry of the chain, inside the caller's transaction.
Result<void> add_audit(sql::Database& database, const AuditEntry& entry);
/// The entry of a run that has just ended, inside the transaction that ended it. Nothing when it
/// has not ended, or has its entry already.
Result<void> add_run_end(sql::Database& database, const std::string& run);
/// Part of the migration to version 9: the chain over what is there.
Result<void> begin_chain(sql::Database& database);

class AuditRepository final : public AuditStore {
 public:
  explicit AuditRepository(Connections& connections) : connections_(connections) {}

  Result<void> add(const AuditEntry& entry) override;
  Result<std::vector<AuditEntry>> list(Page page) override;
  Result<std::vector<ChainedEntry>> chained(std::uint64_t after, std::uint64_t limit) override;
  Result<std::vector<audit::Checkpoint>> checkpoints(std::uint64_t after,
                                                     std::uint64_t limit) override;
  Result<void> add_checkpoint(const audit::Checkpoint& checkpoint) override;
  Result<std::optional<ChainedEntry>> run_end(const std::string& run) override;
  Result<std::optional<std::string>> run_without_end() override;

 private:
  Connections& connections_;
};

}  // namespace dripline::storage
