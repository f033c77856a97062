#include "storage/impl/programs/content_seal.hpp"

#include <algorithm>
#include <array>

namespace dripline::storage {
namespace {

constexpr std::string_view kFormat = "dripline content seal 1";

std::string label_of(const Digest& digest) {
  return fmt::format("content {}", digest.hex());
}

void add_number(Sha256& hash, std::uint64_t number) {
  std::array<std::byte, 8> bytes;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    bytes[i] = static_cast<std::byte>(number >> (8 * (7 - i)));
  hash.update(bytes);
}

Digest seal_of(const ChunkDigests& chunks, std::uint64_t size, const Digest& digest) {
  Sha256 hash;
  hash.update(std::as_bytes(std::span(kFormat)));
  hash.update(digest.bytes);
  add_number(hash, size);
  for (std::size_t position = 0; position < chunks.size(); ++position) {
    add_number(hash, position);
    hash.update(chunks[position].bytes);
  }
  return hash.digest();
}

/// The list as it is stored. Errors: Corrupt (it is not one of so many bytes).
Result<ChunkDigests> read_list(sql::Database& database, const ContentRow& content,
                               const Digest& digest) {
  struct Row {
    std::uint64_t position;
    std::optional<Digest> chunk;
  };
  const auto rows = sql::all_rows(
      database, "SELECT position, sha256 FROM content_chunk WHERE content = ?1 ORDER BY position",
      [](const sql::Statement& row) {
        return Row{row.number(0),
                   row.is_null(1) ? std::nullopt : std::optional(read_digest(row, 1))};
      },
      content.id);
  if (!rows) return fail(rows.error());
  ChunkDigests chunks;
  for (const Row& row : *rows) {
    if (row.position != chunks.size() || !row.chunk) break;
    chunks.push_back(*row.chunk);
  }
  const std::uint64_t due = (content.size + kChunkBytes - 1) / kChunkBytes;
  if (chunks.size() == due && rows->size() == due) return chunks;
  return fail(Errc::Corrupt, "{}: chunk {} (bytes from {}) is missing in the database",
              label_of(digest), chunks.size(), chunks.size() * kChunkBytes);
}

/// Errors: Corrupt, naming the first chunk that is not the one that was stored at its place.
Result<void> check_places(sql::Database& database, const ContentRow& content,
                          const Digest& digest) {
  const auto wrong = sql::first_row(
      database,
      "SELECT position, chunk.id IS NULL FROM content_chunk "
      "LEFT JOIN chunk INDEXED BY chunk_digest ON chunk.id = content_chunk.chunk "
      "WHERE content = ?1 AND chunk.sha256 IS DISTINCT FROM content_chunk.sha256 ORDER BY position "
      "LIMIT 1",
      [](const sql::Statement& row) { return std::pair(row.number(0), row.integer(1) != 0); },
      content.id);
  if (!wrong) return fail(wrong.error());
  if (!*wrong) return {};
  const auto [position, is_missing] = **wrong;
  return fail(Errc::Corrupt, "{}: chunk {} (bytes from {}) {}", label_of(digest), position,
              position * kChunkBytes,
              is_missing ? "is missing in the database" : "is not the one that was stored there");
}

}  // namespace

Result<void> seal_content(sql::Database& database, const ContentRow& content,
                          const Digest& digest) {
  // Rows of a version before 5 have none.
  const auto filled =
      sql::run(database,
               "UPDATE content_chunk SET sha256 = (SELECT sha256 FROM chunk WHERE chunk.id = "
               "content_chunk.chunk) WHERE content = ?1 AND sha256 IS NULL",
               content.id);
  if (!filled) return filled;
  const auto chunks = read_list(database, content, digest);
  if (!chunks) return fail(chunks.error());
  const Digest seal = seal_of(*chunks, content.size, digest);
  return sql::run(database, "UPDATE content SET seal = ?2 WHERE id = ?1", content.id,
                  std::span<const std::byte>(seal.bytes));
}

Result<std::shared_ptr<const ContentList>> check_seal(sql::Database& database,
                                                      const ContentRow& content,
                                                      const Digest& digest) {
  const auto seal = sql::first_row(
      database, "SELECT seal FROM content WHERE id = ?1",
      [](const sql::Statement& row) {
        return row.is_null(0) ? std::nullopt : std::optional(read_digest(row, 0));
      },
      content.id);
  if (!seal) return fail(seal.error());
  if (!*seal || !**seal) return std::shared_ptr<const ContentList>();
  if (auto places = check_places(database, content, digest); !places) return fail(places.error());
  auto chunks = read_list(database, content, digest);
  if (!chunks) return fail(chunks.error());
  if (seal_of(*chunks, content.size, digest) != ***seal) {
    return fail(Errc::Corrupt, "{}: the list of its chunks is not the one that was stored",
                label_of(digest));
  }
  return std::make_shared<const ContentList>(ContentList{content.size, *std::move(chunks)});
}

Result<void> compare_whole(sql::Database& database, const ContentRow& content,
                           const Digest& digest) {
  Sha256 hash;
  for (std::uint64_t offset = 0; offset < content.size; offset += kChunkBytes) {
    const auto bytes = load_range(database, content, offset, kChunkBytes, label_of(digest));
    if (!bytes) return fail(bytes.error());
    hash.update(*bytes);
  }
  const Digest found = hash.digest();
  if (found == digest) return {};
  return fail(Errc::Corrupt, "{}: SHA-256 of its stored bytes is {}", label_of(digest),
              found.hex());
}

std::shared_ptr<const ContentList> SealedContents::find(const Digest& content) {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find(entries_, content, &Entry::content);
  if (found == entries_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found);
  return entries_.front().list;
}

void SealedContents::insert(const Digest& content, std::shared_ptr<const ContentList> list) {
  const std::lock_guard lock(mutex_);
  const auto known = std::ranges::find(entries_, content, &Entry::content);
  if (known != entries_.end()) {
    digests_ -= known->list->chunks.size();
    entries_.erase(known);
  }
  digests_ += list->chunks.size();
  entries_.push_front({content, std::move(list)});
  while (digests_ > kCapacity && entries_.size() > 1) {
    digests_ -= entries_.back().list->chunks.size();
    entries_.pop_back();
  }
}

}  // namespace dripline::storage
