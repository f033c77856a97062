#pragma once

#include "storage/impl/connections.hpp"
#include "storage/programs/release_store.hpp"

namespace dripline::storage {

class ReleaseRepository final : public ReleaseStore {
 public:
  explicit ReleaseRepository(Connections& connections) : connections_(connections) {}

  Result<Revision> decide(const Decision& decision, RevisionState from) override;
  Result<Revision> decide_all(const std::vector<DecisionFrom>& decisions) override;
  Result<std::vector<Revision>> pinned(std::uint64_t decision) override;
  Result<std::vector<Decision>> decisions(const std::string& program,
                                          std::uint64_t revision) override;
  Result<std::set<std::string>> authors(const Digest& content) override;

 private:
  Connections& connections_;
};

}  // namespace dripline::storage
