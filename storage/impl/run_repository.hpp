#pragma once

#include "storage/impl/connections.hpp"

namespace dripline::storage {

/// Promises: storage/store.hpp. Thread-safe.
class RunRepository {
 public:
  RunRepository(Connections& connections, const Clock& clock)
      : connections_(connections), clock_(clock) {}

  Result<void> create(const Run& run);
  Result<Run> find(const std::string& id);
  Result<std::vector<Run>> all(const RunFilter& filter, Page page);
  Result<void> set_state(const std::string& id, RunState state, const std::string& reason);
  struct Progress {
    const std::string& run;
    const Counters& counters;
    std::uint64_t line = 0;
    std::int64_t sequence = -1;
  };
  Result<void> update_counters(const std::string& machine, const Progress& progress);

 private:
  Connections& connections_;
  const Clock& clock_;
};

}  // namespace dripline::storage
