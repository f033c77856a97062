#pragma once

#include "protocol/base/clock.hpp"
#include "storage/impl/connections.hpp"

namespace dripline::storage {

/// The setups of machines, every version of them. Promises: storage/store.hpp. Thread-safe.
class SetupRepository {
 public:
  SetupRepository(Connections& connections, const Clock& clock)
      : connections_(connections), clock_(clock) {}

  Result<SetupRevision> save(const SetupRevision& setup, std::optional<std::uint64_t> base);
  Result<std::vector<SetupRevision>> all(const std::string& machine, Page page);
  Result<SetupRevision> find(const std::string& machine, std::optional<std::uint64_t> number);

 private:
  Connections& connections_;
  const Clock& clock_;
};

}  // namespace dripline::storage
