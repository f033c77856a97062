// The bytes of programs: out of memory, from the server's own disk, from the database, in this
// order.
#include <algorithm>

#include "storage/impl/programs/program_repository.hpp"

namespace dripline::storage {
namespace {

using Bytes = std::vector<std::byte>;

/// At most, read in one statement: the way to a database costs as much as a chunk does.
constexpr std::uint64_t kChunksInOrder = 4;

/// Puts a range together; `chunk(position)` gives a pointer to a CachedChunk, or what ends it.
template <class Chunk>
auto put_together(std::uint64_t offset, std::uint64_t length, Chunk chunk)
    -> std::pair<Bytes, decltype(chunk(offset))> {
  Bytes bytes;
  for (;;) {
    const std::uint64_t at = offset + bytes.size();
    auto piece = chunk(at / kChunkBytes);
    if (!piece) return {std::move(bytes), std::move(piece)};
    const CachedChunk& found = **piece;
    if (at >= found.content_size) return {std::move(bytes), std::move(piece)};
    length = std::min(length, found.content_size - offset);
    bytes.reserve(length);
    const auto part = std::span(found.bytes).subspan(at % kChunkBytes);
    const auto taken = part.first(std::min(part.size(), length - bytes.size()));
    bytes.insert(bytes.end(), taken.begin(), taken.end());
    if (bytes.size() == length) return {std::move(bytes), std::move(piece)};
  }
}

/// Of the chunk at this position.
std::uint64_t size_at(const ContentList& list, std::uint64_t position) {
  return std::min(kChunkBytes, list.size - position * kChunkBytes);
}

}  // namespace

/// Looks at the stored list each time. Errors: NotFound, Corrupt.
Result<ProgramRepository::Sealed> ProgramRepository::sealed(const Digest& content) {
  auto found = connections_.read([&](sql::Database& database) -> Result<Sealed> {
    const auto row = find_content(database, content);
    if (!row) return fail(row.error());
    if (!*row) return fail(Errc::NotFound, "content {} is not in the library", content.hex());
    auto list = check_seal(database, **row, content);
    if (!list) return fail(list.error());
    return Sealed{**row, std::move(*list)};
  });
  if (found && !found->list) found = seal(content, found->row);
  if (!found) return found;
  sealed_.insert(content, found->list);
  if (near_ != nullptr) near_->keep_list(content, *found->list);
  return found;
}

/// A content from before seals were known: all its bytes are read once.
Result<ProgramRepository::Sealed> ProgramRepository::seal(const Digest& content,
                                                          const ContentRow& row) {
  const auto compared = connections_.read(
      [&](sql::Database& database) { return compare_whole(database, row, content); });
  if (!compared) return fail(compared.error());
  return connections_.write([&](sql::Database& database) -> Result<Sealed> {
    if (auto done = seal_content(database, row, content); !done) return fail(done.error());
    auto list = check_seal(database, row, content);
    if (!list) return fail(list.error());
    return Sealed{row, std::move(*list)};
  });
}

Result<void> ProgramRepository::verify_content(const Digest& content) {
  const auto found = sealed(content);
  if (!found) return fail(found.error());
  return {};
}

std::shared_ptr<const ContentList> ProgramRepository::near_list(const Digest& content) {
  auto list = sealed_.find(content);
  if (list != nullptr || near_ == nullptr) return list;
  list = near_->find_list(content);
  if (list != nullptr) sealed_.insert(content, list);
  return list;
}

Result<std::shared_ptr<const ContentList>> ProgramRepository::known_list(const Digest& content) {
  if (auto near = near_list(content)) return near;
  auto found = sealed(content);
  if (!found) return fail(found.error());
  return std::move(found->list);
}

ProgramRepository::ChunkPointer ProgramRepository::near_chunk(const Digest& content,
                                                              std::uint64_t position) {
  if (auto cached = cache_.find({content, position})) return cached;
  if (near_ == nullptr) return nullptr;
  const auto list = near_list(content);
  if (list == nullptr) return nullptr;
  if (position >= list->chunks.size())
    return std::make_shared<const CachedChunk>(CachedChunk{list->size, {}});
  auto bytes = near_->find_chunk({content, list->chunks[position]}, size_at(*list, position));
  if (!bytes) return nullptr;
  auto found = std::make_shared<const CachedChunk>(CachedChunk{list->size, *std::move(bytes)});
  cache_.insert({content, position}, found);
  return found;
}

Result<std::vector<CommittedChunk>> ProgramRepository::load_chunks(const Digest& content,
                                                                   ChunkRange range,
                                                                   const ChunkDigests& digests) {
  return connections_.read([&](sql::Database& database) {
    return load_committed_chunks(database, content, range, digests);
  });
}

/// Chunks to read in one statement: several where the content is read in order, as far as they are
/// not near.
std::uint64_t ProgramRepository::due_at(const Digest& content, std::uint64_t position,
                                        const ChunkDigests& digests) {
  if (position == 0 || cache_.find({content, position - 1}) == nullptr) return 1;
  const std::uint64_t end = std::min(position + kChunksInOrder, std::uint64_t{digests.size()});
  std::uint64_t next = position + 1;
  while (next < end && (near_ == nullptr || near_->use_chunk(digests[next]) == 0)) ++next;
  return next - position;
}

Result<ProgramRepository::ChunkPointer> ProgramRepository::chunk(const Digest& content,
                                                                 std::uint64_t position) {
  if (auto near = near_chunk(content, position)) return near;
  const auto known = known_list(content);
  if (!known) return fail(known.error());
  const ChunkDigests& digests = (*known)->chunks;
  auto read = load_chunks(content, {position, due_at(content, position, digests)}, digests);
  if (!read) return fail(read.error());
  ChunkPointer asked;
  for (CommittedChunk& found : *read) {
    if (near_ != nullptr && !found.bytes.empty())
      near_->keep_chunk(digests[position], found.frame, ContentCache::Reason::Asked);
    auto loaded = std::make_shared<const CachedChunk>(
        CachedChunk{found.content_size, std::move(found.bytes)});
    if (!loaded->bytes.empty()) cache_.insert({content, position}, loaded);
    if (asked == nullptr) asked = std::move(loaded);
    ++position;
  }
  return asked;
}

Result<Bytes> ProgramRepository::read_content(const Digest& content, std::uint64_t offset,
                                              std::uint64_t length) {
  if (auto ours = connections_.check_place(); !ours) return fail(ours.error());
  auto [bytes, last] =
      put_together(offset, length, [&](std::uint64_t at) { return chunk(content, at); });
  if (!last) return fail(last.error());
  return std::move(bytes);
}

std::optional<Bytes> ProgramRepository::near_content(const Digest& content, std::uint64_t offset,
                                                     std::uint64_t length) {
  if (!connections_.check_place()) return std::nullopt;
  auto [bytes, last] = put_together(offset, length, [&](std::uint64_t at) {
    auto near = near_chunk(content, at);
    return near ? std::optional(std::move(near)) : std::nullopt;
  });
  if (!last) return std::nullopt;
  return std::move(bytes);
}

Result<ProgramStore::Fetched> ProgramRepository::fetch_ahead(const Digest& content,
                                                             std::uint64_t position) {
  if (near_ == nullptr) return Fetched{.is_end = true};
  if (auto ours = connections_.check_place(); !ours) return fail(ours.error());
  const auto known = known_list(content);
  if (!known) return fail(known.error());
  const ChunkDigests& digests = (*known)->chunks;
  if (position >= digests.size()) return Fetched{.is_end = true};
  const Digest& chunk = digests[position];
  if (const auto bytes = near_->use_chunk(chunk); bytes > 0) return Fetched{.bytes = bytes};
  const auto read = load_chunks(content, {.first = position}, digests);
  if (!read) return fail(read.error());
  near_->keep_chunk(chunk, read->front().frame, ContentCache::Reason::Ahead);
  return Fetched{.bytes = near_->use_chunk(chunk)};
}

}  // namespace dripline::storage
