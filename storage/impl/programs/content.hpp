#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "protocol/base/digest.hpp"
#include "storage/content_cache.hpp"
#include "storage/programs/chunk_codec.hpp"
#include "storage/sql/query.hpp"

/// Rows of content, content_chunk and chunk. Functions that write run inside the caller's
/// transaction.

namespace dripline::storage {

struct ContentRow {
  std::int64_t id = 0;
  std::uint64_t size = 0;
};

Digest read_digest(const sql::Statement& row, int column);

Result<std::optional<ContentRow>> find_content(sql::Database& database, const Digest& digest);

/// A new content without bytes; returns its id.
Result<std::int64_t> create_content(sql::Database& database);

/// Puts the chunks at `position`, `position` + 1 ...; the first one replaces what was there.
/// A damaged chunk of the same digest is healed.
Result<void> put_chunks(sql::Database& database, std::int64_t content, std::uint64_t position,
                        std::span<const EncodedChunk> chunks);

/// Deletes the content and those of its chunks that no other content has.
Result<void> drop_content(sql::Database& database, std::int64_t content);

/// `content` gets the chunks of `replacement`, which is deleted.
Result<void> replace_content(sql::Database& database, std::int64_t content,
                             std::int64_t replacement);

/// One chunk, checked: it is whole, and the one that was stored at this place (`expected`, if
/// given). `label` names the content in errors. Errors: Corrupt (also: missing).
Result<std::vector<std::byte>> load_chunk(sql::Database& database, std::int64_t content,
                                          std::uint64_t position, std::string_view label,
                                          const Digest* expected = nullptr);

/// The same of a committed content, found by its digest. Past its end: no bytes.
struct CommittedChunk {
  std::uint64_t content_size = 0;
  std::vector<std::byte> bytes;
  std::vector<std::byte> frame;  ///< the same as it is stored
};
struct ChunkRange {
  std::uint64_t first = 0;
  std::uint64_t count = 1;
};
/// The chunk at `range.first` and those after it, in one statement: as many of the range as the
/// content has and as are good. Errors are those of the first one: also NotFound (there is no such
/// content).
Result<std::vector<CommittedChunk>> load_committed_chunks(sql::Database& database,
                                                          const Digest& content, ChunkRange range,
                                                          const ChunkDigests& expected);

/// A range of bytes, checked chunk by chunk; ends at the content's end.
Result<std::vector<std::byte>> load_range(sql::Database& database, const ContentRow& content,
                                          std::uint64_t offset, std::uint64_t length,
                                          std::string_view label);

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
