#pragma once

#include "storage/impl/chunk_cache.hpp"
#include "storage/impl/connections.hpp"
#include "storage/impl/content_seal.hpp"
#include "storage/impl/revision_rows.hpp"

namespace dripline::storage {

/// Programs, their revisions and the bytes of these. Promises: storage/store.hpp. Thread-safe.
class ProgramRepository {
 public:
  ProgramRepository(Connections& connections, std::uint64_t cache_bytes)
      : connections_(connections), cache_(cache_bytes) {}

  Result<std::vector<ProgramSummary>> programs(Page page);
  Result<std::vector<Revision>> revisions(const std::string& program);
  Result<Revision> revision(const std::string& program, std::optional<std::uint64_t> number);
  Result<Revision> accept(const Judgement& judgement);
  Result<void> reject(const Judgement& judgement);
  Result<void> remove(const std::string& program);
  Result<Revision> copy(const ProgramMove& move, std::optional<std::uint64_t> number, UtcTime now);
  Result<void> rename(const ProgramMove& move, UtcTime now);
  Result<std::vector<std::byte>> read_content(const Digest& content, std::uint64_t offset,
                                              std::uint64_t length);
  Result<void> verify_content(const Digest& content);

 private:
  struct Sealed {
    ContentRow row;
    std::shared_ptr<const ChunkDigests> chunks;  ///< null: not sealed yet
  };
  Result<Sealed> sealed(const Digest& content);
  Result<Sealed> seal(const Digest& content, const ContentRow& row);
  Result<std::shared_ptr<const CachedChunk>> chunk(const Digest& content, std::uint64_t position);

  Connections& connections_;
  ChunkCache cache_;
  SealedContents sealed_;
};

}  // namespace dripline::storage
