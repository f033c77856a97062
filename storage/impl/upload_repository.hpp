#pragma once

#include "storage/impl/connections.hpp"
#include "storage/impl/upload_progress.hpp"
#include "storage/upload_store.hpp"

namespace dripline::storage {

/// Pieces are hashed and compressed before the writer is taken, so a big
/// upload delays no records.
class UploadRepository final : public UploadStore {
 public:
  UploadRepository(Connections& connections, const Clock& clock)
      : connections_(connections), clock_(clock) {}

  Result<Upload> begin(const Upload& upload) override;
  Result<Upload> find(const std::string& id) override;
  Result<Upload> append(const std::string& id, std::uint64_t offset,
                        std::span<const std::byte> bytes) override;
  Result<std::vector<std::byte>> read(const std::string& id, std::uint64_t offset,
                                      std::uint64_t length) override;
  Result<void> set_control(const std::string& id, const std::string& control) override;
  Result<Revision> commit(const std::string& id, const std::optional<Digest>& expected) override;
  Result<void> abandon(const std::string& id) override;
  Result<std::uint64_t> drop_idle(std::chrono::seconds passed, std::chrono::seconds life) override;

 private:
  Result<std::shared_ptr<UploadProgress>> progress_of(const std::string& id);
  Result<Upload> store_piece(const std::string& id, UploadProgress& progress,
                             std::span<const std::byte> bytes);
  Result<Upload> check_resent(const std::string& id, const UploadProgress& progress,
                              std::uint64_t offset, std::span<const std::byte> bytes);
  Result<Digest> digest_of(const std::string& id, const UploadProgress& progress);

  Connections& connections_;
  const Clock& clock_;
  UploadProgressTable table_;
};

}  // namespace dripline::storage
