#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "protocol/base/digest.hpp"

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

}  // namespace dripline::storage
