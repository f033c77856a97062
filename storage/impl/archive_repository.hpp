#pragma once

#include "storage/archive_store.hpp"
#include "storage/impl/connections.hpp"

namespace dripline::storage {

class ArchiveRepository final : public ArchiveStore {
 public:
  explicit ArchiveRepository(Connections& connections) : connections_(connections) {}

  Result<std::vector<ArchivableRecords>> archivable_records() override;
  Result<std::vector<Record>> records(const ArchivableRecords& range, std::uint64_t limit) override;
  Result<std::vector<MeasuredPart>> ended_parts(std::uint64_t after, std::uint64_t limit) override;
  Result<std::vector<measurement::Measurement>> measurements_of(
      std::uint64_t part, const std::optional<MeasurementPlace>& after,
      std::uint64_t limit) override;
  Result<std::vector<ReportFinding>> findings_of(std::uint64_t part) override;
  Result<std::uint64_t> size(ArchiveKind kind) override;
  Result<std::uint64_t> add(const Archive& archive, const Actor& who) override;
  Result<std::uint64_t> remove_rows(std::uint64_t id, std::uint64_t limit) override;
  Result<std::vector<Archive>> list(Page page) override;
  Result<std::vector<Archive>> unremoved() override;
  Result<std::vector<Archive>> uncounted() override;

 private:
  Connections& connections_;
};

}  // namespace dripline::storage
