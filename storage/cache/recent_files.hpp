#pragma once

#include <cstdint>
#include <list>
#include <optional>
#include <unordered_map>

#include "protocol/base/digest.hpp"

namespace dripline::cache {

/// A file of the cache: a chunk, or the list of a content.
struct FileKey {
  enum class Kind : std::uint8_t { Chunk, List };
  Kind kind = Kind::Chunk;
  Digest digest;
  friend bool operator==(const FileKey&, const FileKey&) = default;
};

/// Which files are there, how long they are, and which was used longest ago. One thread at a time.
class RecentFiles {
 public:
  /// The one used last. It is not there yet.
  void add(const FileKey& key, std::uint64_t bytes);
  /// Becomes the one used last. Its bytes; 0: it is not there.
  std::uint64_t use(const FileKey& key);
  void drop(const FileKey& key);
  bool has(const FileKey& key) const { return places_.contains(key); }
  /// nullopt: there are none.
  std::optional<FileKey> oldest() const;
  std::uint64_t bytes() const { return bytes_; }
  std::uint64_t count() const { return places_.size(); }

 private:
  struct Entry {
    FileKey key;
    std::uint64_t bytes;
  };
  struct Hash {
    std::size_t operator()(const FileKey& key) const;
  };
  std::uint64_t bytes_ = 0;
  std::list<Entry> entries_;  // used last first
  std::unordered_map<FileKey, std::list<Entry>::iterator, Hash> places_;
};

}  // namespace dripline::cache
