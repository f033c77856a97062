#pragma once

#include "storage/impl/connections.hpp"
#include "storage/measurement_store.hpp"

namespace dripline::storage {

class MeasurementRepository final : public MeasurementStore {
 public:
  explicit MeasurementRepository(Connections& connections) : connections_(connections) {}

  Result<std::vector<UnderivedRecords>> underived() override;
  Result<std::string> state(const std::string& machine) override;
  Result<void> save_state(const std::string& machine, const std::string& state) override;
  Result<std::uint64_t> next_part_id() override;
  Result<void> commit(const DerivedBatch& batch) override;
  Result<void> replace(const std::string& run, const DerivedBatch& batch) override;
  Result<std::vector<measurement::Measurement>> list(const MeasurementFilter& filter,
                                                     const std::optional<MeasurementPlace>& after,
                                                     std::uint64_t limit) override;
  Result<std::vector<measurement::Measurement>> list_newest(
      const MeasurementFilter& filter, const std::optional<MeasurementPlace>& before,
      std::uint64_t limit) override;
  Result<std::vector<MeasuredPart>> parts(const PartFilter& filter, Page page) override;
  Result<MeasuredPart> part(std::uint64_t id) override;
  Result<RunParts> parts_of_run(const std::string& run) override;
  Result<std::vector<ReportFinding>> findings(const PartFilter& filter, Page page) override;
  Result<std::vector<std::string>> characteristics(
      const std::optional<std::string>& machine) override;

 private:
  Connections& connections_;
};

}  // namespace dripline::storage
