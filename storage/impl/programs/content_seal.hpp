#pragma once

#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "storage/impl/programs/content.hpp"

/// A content is a list of chunks, and each chunk is checked against its own digest. That the list
/// is the one that was committed is what its seal says: a digest over the content's own digest, its
/// size and its chunks' digests in order, made when all bytes had been compared with the content's
/// SHA-256. Checking it reads a few dozen bytes for each 256 KiB, so a run of a program of any size
/// begins at once and is still refused when one row names another chunk.
namespace dripline::storage {

/// Seals a content whose bytes were compared with `digest` in this transaction or before it.
/// Errors: Corrupt (rows are missing).
Result<void> seal_content(sql::Database& database, const ContentRow& content, const Digest& digest);

/// Null: it is not sealed yet. Errors: Corrupt, naming the chunk where that is known.
Result<std::shared_ptr<const ContentList>> check_seal(sql::Database& database,
                                                      const ContentRow& content,
                                                      const Digest& digest);

/// Reads all bytes of a content that was committed before seals were known. Errors: Corrupt (they
/// are not what `digest` says, or a chunk is damaged).
Result<void> compare_whole(sql::Database& database, const ContentRow& content,
                           const Digest& digest);

/// Those checked last, at most kCapacity digests of chunks. Thread-safe.
class SealedContents {
 public:
  static constexpr std::size_t kCapacity = 128 * 1024;  ///< 4 MiB; 32 GiB of programs
  std::shared_ptr<const ContentList> find(const Digest& content);
  void insert(const Digest& content, std::shared_ptr<const ContentList> list);

 private:
  struct Entry {
    Digest content;
    std::shared_ptr<const ContentList> list;
  };
  std::mutex mutex_;
  std::list<Entry> entries_;  // used last first
  std::size_t digests_ = 0;
};

}  // namespace dripline::storage
