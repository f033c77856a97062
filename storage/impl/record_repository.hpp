#pragma once

#include "storage/impl/connections.hpp"

namespace dripline::storage {

/// Promises: storage/store.hpp. Thread-safe.
class RecordRepository {
 public:
  RecordRepository(Connections& connections, const Clock& clock)
      : connections_(connections), clock_(clock) {}

  Result<std::uint64_t> store(const RecordBatch& batch);
  Result<std::vector<MachineReport>> reports();
  Result<std::vector<Record>> without_run(const std::string& machine, Page page);
  Result<std::vector<MemoryReport>> memory(const std::string& machine,
                                           const std::optional<std::string>& run, Page page);
  Result<std::vector<Record>> of_run(const std::string& run, const std::string& kind, Page page);

 private:
  Connections& connections_;
  const Clock& clock_;
};

}  // namespace dripline::storage
