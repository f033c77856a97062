#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "protocol/base/digest.hpp"

namespace dripline::storage {

/// Of the chunks of a content, in their order.
using ChunkDigests = std::vector<Digest>;

/// What a committed content consists of. It never changes.
struct ContentList {
  std::uint64_t size = 0;
  ChunkDigests chunks;
  friend bool operator==(const ContentList&, const ContentList&) = default;
};

/// A second home of program text, nearer than the database: what it gives is checked, and what it
/// does not have is fetched from the database as if it were not there. It has no errors.
/// Thread-safe.
class ContentCache {
 public:
  /// Why a chunk came from the database: someone asked for it, or it may be asked for.
  enum class Reason : std::uint8_t { Asked, Ahead };
  /// A chunk, and the content that it was asked for.
  struct Place {
    Digest content, chunk;
  };

  virtual ~ContentCache() = default;

  /// Null: it is not there.
  virtual std::shared_ptr<const ContentList> find_list(const Digest& content) = 0;
  /// One whose seal was checked.
  virtual void keep_list(const Digest& content, const ContentList& list) = 0;
  /// The plain bytes, checked against the chunk's digest; `size` is how many they must be.
  virtual std::optional<std::vector<std::byte>> find_chunk(const Place& place,
                                                           std::uint64_t size) = 0;
  /// `frame`: the chunk as it is stored (chunk_codec.hpp).
  virtual void keep_chunk(const Digest& chunk, std::span<const std::byte> frame, Reason reason) = 0;
  /// The bytes that it takes, and it counts as used; 0: it is not there.
  virtual std::uint64_t use_chunk(const Digest& chunk) = 0;
};

}  // namespace dripline::storage
