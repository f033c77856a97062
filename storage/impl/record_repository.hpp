#pragma once

#include "storage/impl/connections.hpp"
#include "storage/record_store.hpp"

namespace dripline::storage {

class RecordRepository final : public RecordStore {
 public:
  RecordRepository(Connections& connections, const Clock& clock)
      : connections_(connections), clock_(clock) {}

  Result<std::uint64_t> store(const RecordBatch& batch) override;
  Result<std::vector<Record>> of_run(const std::string& run, const std::string& kind,
                                     Page page) override;
  Result<std::vector<MachineReport>> machine_reports() override;
  Result<std::vector<Record>> machine_report(const std::string& machine, Page page) override;
  Result<std::vector<MemoryReport>> memory_reports(const std::string& machine,
                                                   const std::optional<std::string>& run,
                                                   Page page) override;

 private:
  Connections& connections_;
  const Clock& clock_;
};

}  // namespace dripline::storage
