#pragma once

#include "storage/impl/connections.hpp"
#include "storage/impl/programs/content.hpp"
#include "storage/impl/programs/content_seal.hpp"
#include "storage/impl/programs/revision_rows.hpp"
#include "storage/programs/program_store.hpp"

namespace dripline::storage {

/// Where program text is nearer than in the database.
struct Caches {
  std::uint64_t memory_bytes = 0;   ///< of chunks, kept checked and decompressed
  ContentCache* content = nullptr;  ///< null: none; must outlive the repository
};

class ProgramRepository final : public ProgramStore {
 public:
  ProgramRepository(Connections& connections, const Clock& clock, const Caches& caches)
      : connections_(connections),
        clock_(clock),
        cache_(caches.memory_bytes),
        near_(caches.content) {}

  using ProgramStore::list;
  Result<std::vector<ProgramSummary>> list(const ProgramFilter& filter, Page page) override;
  Result<ProgramFields> fields(const std::string& program) override;
  Result<void> describe(const Description& description) override;
  Result<std::uint64_t> count() override;
  Result<std::vector<Revision>> revisions(const std::string& program) override;
  Result<Revision> revision(const std::string& program,
                            std::optional<std::uint64_t> number) override;
  Result<Revision> accept(const std::string& program, std::uint64_t number,
                          const Actor& who) override;
  Result<void> reject(const std::string& program, std::uint64_t number, const Actor& who) override;
  Result<Revision> copy(const ProgramMove& move, std::optional<std::uint64_t> number) override;
  Result<void> rename(const ProgramMove& move) override;
  Result<void> remove(const std::string& program) override;
  Result<std::vector<std::byte>> read_content(const Digest& content, std::uint64_t offset,
                                              std::uint64_t length) override;
  std::optional<std::vector<std::byte>> near_content(const Digest& content, std::uint64_t offset,
                                                     std::uint64_t length) override;
  Result<Fetched> fetch_ahead(const Digest& content, std::uint64_t position) override;
  Result<void> verify_content(const Digest& content) override;

 private:
  struct Sealed {
    ContentRow row;
    std::shared_ptr<const ContentList> list;  ///< null: not sealed yet
  };
  Result<Sealed> sealed(const Digest& content);
  Result<Sealed> seal(const Digest& content, const ContentRow& row);
  using ChunkPointer = std::shared_ptr<const CachedChunk>;
  /// All of them null where it is not there.
  std::shared_ptr<const ContentList> near_list(const Digest& content);
  ChunkPointer near_chunk(const Digest& content, std::uint64_t position);
  Result<std::shared_ptr<const ContentList>> known_list(const Digest& content);
  Result<ChunkPointer> chunk(const Digest& content, std::uint64_t position);
  std::uint64_t due_at(const Digest& content, std::uint64_t position, const ChunkDigests& digests);
  Result<std::vector<CommittedChunk>> load_chunks(const Digest& content, ChunkRange range,
                                                  const ChunkDigests& digests);

  Connections& connections_;
  const Clock& clock_;
  ChunkCache cache_;
  ContentCache* const near_;  ///< null: none
  SealedContents sealed_;
};

}  // namespace dripline::storage
