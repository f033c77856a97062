#pragma once

#include "storage/impl/connections.hpp"
#include "storage/run_store.hpp"

namespace dripline::storage {

class RunRepository final : public RunStore {
 public:
  RunRepository(Connections& connections, const Clock& clock)
      : connections_(connections), clock_(clock) {}

  Result<void> create(const Run& run) override;
  Result<Run> find(const std::string& id) override;
  Result<std::vector<Run>> list(const RunFilter& filter, Page page) override;
  Result<void> set_state(const std::string& id, RunState state, const std::string& reason) override;
  Result<void> update_counters(const RunProgress& progress) override;

 private:
  Connections& connections_;
  const Clock& clock_;
};

}  // namespace dripline::storage
