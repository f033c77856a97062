#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/base/digest.hpp"
#include "storage/impl/connections.hpp"
#include "storage/impl/programs/upload_progress.hpp"
#include "storage/programs/attachment_store.hpp"
#include "storage/programs/chunk_codec.hpp"
#include "storage/programs/upload_store.hpp"

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
  /// Promises: AttachmentStore::commit.
  Result<Attachment> commit_attachment(const std::string& id, const std::optional<Digest>& expected,
                                       const Actor& who);
  Result<void> abandon(const std::string& id) override;
  Result<std::uint64_t> drop_idle(std::chrono::seconds passed, std::chrono::seconds life) override;

 private:
  Result<std::shared_ptr<UploadProgress>> progress_of(const std::string& id);
  Result<Upload> store_piece(const std::string& id, UploadProgress& progress,
                             std::span<const std::byte> bytes);
  /// Of a piece, what one transaction stores.
  struct Part {
    std::span<const std::byte> bytes;
    std::span<const EncodedChunk> chunks;  ///< the first one begins with the tail
  };
  Result<Upload> store_part(const std::string& id, UploadProgress& progress, const Part& part,
                            Durability durability);
  Result<Upload> check_resent(const std::string& id, std::uint64_t offset,
                              std::span<const std::byte> bytes);
  template <class Publish>
  auto finish(const std::string& id, const std::optional<Digest>& expected, Publish publish)
      -> std::invoke_result_t<Publish, sql::Database&, const Upload&, std::int64_t, const Digest&>;
  Result<void> check_attachment_size(const std::string& id);
  Result<Digest> digest_of(const std::string& id, const UploadProgress& progress);

  Connections& connections_;
  const Clock& clock_;
  UploadProgressTable table_;
};

}  // namespace dripline::storage
