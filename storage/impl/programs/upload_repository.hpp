#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "protocol/base/digest.hpp"
#include "storage/impl/connections.hpp"
#include "storage/programs/attachment_store.hpp"
#include "storage/programs/upload_store.hpp"

namespace dripline::storage {

/// Makes the next piece of an upload cheap: never ahead of the database, and loaded from it after a
/// restart. Hold `mutex` while using it.
struct UploadProgress {
  std::mutex mutex;
  std::int64_t content = 0;
  std::uint64_t received = 0;
  std::optional<Sha256> hash;   ///< of everything received; absent when the beginning was not seen
  std::vector<std::byte> tail;  ///< plain bytes of the unfinished last chunk

  /// After `bytes` were stored.
  void advance(std::span<const std::byte> bytes);
};

/// The uploads used last; bounded, so that abandoned ones cost no memory. Thread-safe.
class UploadProgressTable {
 public:
  /// Null when it is not in the table.
  std::shared_ptr<UploadProgress> find(const std::string& id);
  /// Returns the one that is kept: another thread's when that was faster.
  std::shared_ptr<UploadProgress> insert(const std::string& id,
                                         std::shared_ptr<UploadProgress> progress);
  void erase(const std::string& id);
  void clear();

 private:
  static constexpr std::size_t kCapacity = 32;  // of at most a chunk each: 8 MiB
  std::mutex mutex_;
  std::vector<std::pair<std::string, std::shared_ptr<UploadProgress>>> entries_;  // used last, last
};

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
  Result<Upload> check_resent(const std::string& id, const UploadProgress& progress,
                              std::uint64_t offset, std::span<const std::byte> bytes);
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
