#pragma once

#include "storage/impl/connections.hpp"
#include "storage/setup_store.hpp"

namespace dripline::storage {

class SetupRepository final : public SetupStore {
 public:
  SetupRepository(Connections& connections, const Clock& clock)
      : connections_(connections), clock_(clock) {}

  Result<SetupRevision> save(const SetupRevision& setup,
                             std::optional<std::uint64_t> base) override;
  Result<std::vector<SetupRevision>> list(const std::string& machine, Page page) override;
  Result<SetupRevision> find(const std::string& machine,
                             std::optional<std::uint64_t> number) override;

 private:
  Connections& connections_;
  const Clock& clock_;
};

}  // namespace dripline::storage
