#pragma once

#include "storage/impl/connections.hpp"
#include "storage/offset_store.hpp"

namespace dripline::storage {

class OffsetRepository final : public OffsetStore {
 public:
  explicit OffsetRepository(Connections& connections) : connections_(connections) {}

  Result<OffsetRules> save_rules(const OffsetRules& rules, const Actor& who) override;
  Result<OffsetRules> rules(const std::string& machine) override;
  Result<KeptProposal> propose(const OffsetProposal& proposal) override;
  Result<void> withdraw(const std::string& machine, const std::string& target, UtcTime now,
                        const std::string& reason) override;
  Result<OffsetProposal> find(std::uint64_t id) override;
  Result<std::vector<OffsetProposal>> list(const OffsetFilter& filter, Page page) override;
  Result<SetupRevision> apply(const OffsetDecision& decision, const SetupRevision& setup) override;
  Result<OffsetProposal> reject(const OffsetDecision& decision) override;

 private:
  Connections& connections_;
};

}  // namespace dripline::storage
