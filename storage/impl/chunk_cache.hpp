#pragma once

#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "protocol/base/digest.hpp"

namespace dripline::storage {

/// A checked, decompressed chunk of a committed content.
struct CachedChunk {
  std::uint64_t content_size = 0;
  std::vector<std::byte> bytes;
};

/// The chunks read last, up to a number of bytes. Committed content never changes, so nothing in
/// here is ever stale. Thread-safe.
class ChunkCache {
 public:
  struct Key {
    Digest content;
    std::uint64_t position = 0;
    friend auto operator<=>(const Key&, const Key&) = default;
  };

  explicit ChunkCache(std::uint64_t capacity) : capacity_(capacity) {}
  /// Null when it is not cached.
  std::shared_ptr<const CachedChunk> find(const Key& key);
  void insert(const Key& key, std::shared_ptr<const CachedChunk> chunk);

 private:
  struct Entry {
    Key key;
    std::shared_ptr<const CachedChunk> chunk;
  };
  const std::uint64_t capacity_;  // bytes
  std::mutex mutex_;
  std::uint64_t bytes_ = 0;
  std::list<Entry> entries_;  // used last first
  std::map<Key, std::list<Entry>::iterator> index_;
};

}  // namespace dripline::storage
