#include "storage/impl/programs/content.hpp"

#include <algorithm>

namespace dripline::storage {

namespace {

Result<std::int64_t> put_chunk(sql::Database& database, const EncodedChunk& chunk) {
  // The update heals a chunk whose stored bytes were damaged: the new bytes are known to be good.
  const auto stored = sql::run(
      database,
      "INSERT INTO chunk (sha256, size, data) VALUES (?1, ?2, ?3) ON CONFLICT (sha256) DO UPDATE "
      "SET size = excluded.size, data = excluded.data "
      "WHERE chunk.size <> excluded.size OR chunk.data <> excluded.data",
      std::span<const std::byte>(chunk.digest.bytes), chunk.size,
      std::span<const std::byte>(chunk.data));
  if (!stored) return fail(stored.error());
  const auto id = sql::first_row(
      database, "SELECT id FROM chunk WHERE sha256 = ?1",
      [](const sql::Statement& row) { return row.integer(0); },
      std::span<const std::byte>(chunk.digest.bytes));
  if (!id) return fail(id.error());
  return id->value();
}

Result<std::optional<std::int64_t>> chunk_at(sql::Database& database, std::int64_t content,
                                             std::uint64_t position) {
  return sql::first_row(
      database, "SELECT chunk FROM content_chunk WHERE content = ?1 AND position = ?2",
      [](const sql::Statement& row) { return row.integer(0); }, content, position);
}

Result<void> drop_chunk_if_unused(sql::Database& database, std::int64_t chunk) {
  return sql::run(database,
                  "DELETE FROM chunk WHERE id = ?1 AND NOT EXISTS "
                  "(SELECT 1 FROM content_chunk WHERE chunk = ?1)",
                  chunk);
}

}  // namespace

Digest read_digest(const sql::Statement& row, int column) {
  Digest digest;
  const auto stored = row.blob(column);  // the schema demands 32 bytes
  std::copy_n(stored.begin(), std::min(stored.size(), Digest::kSize), digest.bytes.begin());
  return digest;
}

Result<std::optional<ContentRow>> find_content(sql::Database& database, const Digest& digest) {
  return sql::first_row(
      database, "SELECT id, size FROM content WHERE sha256 = ?1",
      [](const sql::Statement& row) {
        return ContentRow{row.integer(0), row.number(1)};
      },
      std::span<const std::byte>(digest.bytes));
}

Result<std::int64_t> create_content(sql::Database& database) {
  return sql::insert(database, "INSERT INTO content (sha256, size) VALUES (NULL, 0) RETURNING id");
}

Result<void> put_chunks(sql::Database& database, std::int64_t content, std::uint64_t position,
                        std::span<const EncodedChunk> chunks) {
  const auto replaced = chunk_at(database, content, position);
  if (!replaced) return fail(replaced.error());
  std::uint64_t bytes_before = position * kChunkBytes;
  for (const EncodedChunk& chunk : chunks) {
    const auto id = put_chunk(database, chunk);
    if (!id) return fail(id.error());
    const auto placed = sql::run(
        database,
        "INSERT INTO content_chunk (content, position, chunk, sha256) "
        "VALUES (?1, ?2, ?3, ?4) ON CONFLICT (content, position) DO UPDATE "
        "SET chunk = excluded.chunk, sha256 = excluded.sha256",
        content, bytes_before / kChunkBytes, *id, std::span<const std::byte>(chunk.digest.bytes));
    if (!placed) return placed;
    bytes_before += chunk.size;
  }
  const auto counted =
      sql::run(database, "UPDATE content SET size = ?2 WHERE id = ?1", content, bytes_before);
  if (!counted) return counted;
  if (*replaced) return drop_chunk_if_unused(database, **replaced);
  return {};
}

Result<void> drop_content(sql::Database& database, std::int64_t content) {
  const auto chunks = sql::all_rows(
      database, "SELECT DISTINCT chunk FROM content_chunk WHERE content = ?1",
      [](const sql::Statement& row) { return row.integer(0); }, content);
  if (!chunks) return fail(chunks.error());
  auto done = sql::run(database, "DELETE FROM content_chunk WHERE content = ?1", content);
  if (!done) return done;
  for (const std::int64_t chunk : *chunks) {
    if (done = drop_chunk_if_unused(database, chunk); !done) return done;
  }
  return sql::run(database, "DELETE FROM content WHERE id = ?1", content);
}

Result<void> replace_content(sql::Database& database, std::int64_t content,
                             std::int64_t replacement) {
  const auto chunks = sql::all_rows(
      database, "SELECT DISTINCT chunk FROM content_chunk WHERE content = ?1",
      [](const sql::Statement& row) { return row.integer(0); }, content);
  if (!chunks) return fail(chunks.error());
  auto done = sql::run(database, "DELETE FROM content_chunk WHERE content = ?1", content);
  if (!done) return done;
  done = sql::run(database, "UPDATE content_chunk SET content = ?1 WHERE content = ?2", content,
                  replacement);
  if (!done) return done;
  done = sql::run(database,
                  "UPDATE content SET seal = NULL, size = (SELECT size FROM content WHERE id = "
                  "?2) WHERE id = ?1",
                  content, replacement);
  if (!done) return done;
  for (const std::int64_t chunk : *chunks) {
    if (done = drop_chunk_if_unused(database, chunk); !done) return done;
  }
  return sql::run(database, "DELETE FROM content WHERE id = ?1", replacement);
}

namespace {

std::string place_of(std::string_view label, std::uint64_t position) {
  return fmt::format("{}: chunk {} (bytes from {})", label, position, position * kChunkBytes);
}

/// The row's columns from `first` on: digest, size and data of the chunk, and the digest that is
/// listed at its place.
Result<std::vector<std::byte>> read_chunk(const sql::Statement& row, int first,
                                          const Digest* expected) {
  const Digest digest = read_digest(row, first);
  const bool is_listed = row.is_null(first + 3) || read_digest(row, first + 3) == digest;
  if (!is_listed || (expected != nullptr && *expected != digest)) {
    return fail(Errc::Corrupt, "it is not the one that was stored there");
  }
  return decode_chunk(digest, row.number(first + 1), row.blob(first + 2));
}

}  // namespace

Result<std::vector<std::byte>> load_chunk(sql::Database& database, std::int64_t content,
                                          std::uint64_t position, std::string_view label,
                                          const Digest* expected) {
  auto plain = sql::first_row(
      database,
      "SELECT chunk.sha256, chunk.size, chunk.data, content_chunk.sha256 FROM content_chunk "
      "JOIN chunk ON chunk.id = content_chunk.chunk "
      "WHERE content_chunk.content = ?1 AND content_chunk.position = ?2",
      [expected](const sql::Statement& row) { return read_chunk(row, 0, expected); }, content,
      position);
  const std::string place = place_of(label, position);
  if (!plain) return fail(plain.error().code, "{}: {}", place, plain.error().what);
  if (!*plain) return fail(Errc::Corrupt, "{} is missing in the database", place);
  if (!**plain) return fail(Errc::Corrupt, "{} is damaged: {}", place, (**plain).error().what);
  return std::move(**plain);
}

namespace {

/// The row's columns: size of the content, position, and those of `read_chunk`. Past the end of
/// the content there is no chunk.
Result<CommittedChunk> read_committed(const sql::Statement& row, std::uint64_t position,
                                      std::string_view label, const ChunkDigests& expected) {
  CommittedChunk chunk{row.number(0), {}, {}};
  if (position * kChunkBytes >= chunk.content_size) return chunk;
  if (position >= expected.size()) {
    return fail(Errc::Corrupt, "{}: chunk {} is more than it was stored with", label, position);
  }
  const std::string place = place_of(label, position);
  if (row.is_null(2) || row.number(1) != position)
    return fail(Errc::Corrupt, "{} is missing in the database", place);
  auto bytes = read_chunk(row, 2, &expected[position]);
  if (!bytes) return fail(Errc::Corrupt, "{} is damaged: {}", place, bytes.error().what);
  const auto due = std::min(kChunkBytes, chunk.content_size - position * kChunkBytes);
  if (bytes->size() != due) {
    return fail(Errc::Corrupt, "{}: chunk {} has {} bytes instead of {}", label, position,
                bytes->size(), due);
  }
  chunk.bytes = *std::move(bytes);
  const auto frame = row.blob(4);
  chunk.frame.assign(frame.begin(), frame.end());
  return chunk;
}

}  // namespace

Result<std::vector<CommittedChunk>> load_committed_chunks(sql::Database& database,
                                                          const Digest& content, ChunkRange range,
                                                          const ChunkDigests& expected) {
  const auto label = fmt::format("content {}", content.hex());
  std::uint64_t position = range.first;
  auto rows = sql::all_rows(
      database,
      "SELECT content.size, content_chunk.position, chunk.sha256, chunk.size, chunk.data, "
      "content_chunk.sha256 FROM content LEFT JOIN content_chunk "
      "ON content_chunk.content = content.id AND content_chunk.position BETWEEN ?2 AND ?3 "
      "LEFT JOIN chunk ON chunk.id = content_chunk.chunk "
      "WHERE content.sha256 = ?1 ORDER BY content_chunk.position",
      [&](const sql::Statement& row) { return read_committed(row, position++, label, expected); },
      std::span<const std::byte>(content.bytes), range.first, range.first + range.count - 1);
  if (!rows) return fail(rows.error().code, "{}: {}", label, rows.error().what);
  if (rows->empty()) return fail(Errc::NotFound, "{} is not in the library", label);
  if (const auto& first = rows->front(); !first) return fail(first.error());
  std::vector<CommittedChunk> chunks;
  for (auto& row : *rows) {
    if (!row) break;  // its reader is told
    chunks.push_back(*std::move(row));
  }
  return chunks;
}

Result<std::vector<std::byte>> load_range(sql::Database& database, const ContentRow& content,
                                          std::uint64_t offset, std::uint64_t length,
                                          std::string_view label) {
  std::vector<std::byte> bytes;
  if (offset >= content.size) return bytes;
  length = std::min(length, content.size - offset);
  bytes.reserve(length);
  while (bytes.size() < length) {
    const std::uint64_t at = offset + bytes.size();
    const auto chunk = load_chunk(database, content.id, at / kChunkBytes, label);
    if (!chunk) return fail(chunk.error());
    const std::uint64_t begin = at % kChunkBytes;
    if (begin >= chunk->size()) {
      return fail(Errc::Corrupt, "{}: chunk {} is too short", label, at / kChunkBytes);
    }
    const auto part = std::span(*chunk).subspan(begin);
    const auto taken = part.first(std::min(part.size(), length - bytes.size()));
    bytes.insert(bytes.end(), taken.begin(), taken.end());
  }
  return bytes;
}

std::shared_ptr<const CachedChunk> ChunkCache::find(const Key& key) {
  const std::lock_guard lock(mutex_);
  const auto found = index_.find(key);
  if (found == index_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found->second);
  return found->second->chunk;
}

void ChunkCache::insert(const Key& key, std::shared_ptr<const CachedChunk> chunk) {
  const std::lock_guard lock(mutex_);
  if (index_.contains(key)) return;  // another reader was faster
  bytes_ += chunk->bytes.size();
  entries_.push_front({key, std::move(chunk)});
  index_.emplace(key, entries_.begin());
  while (bytes_ > capacity_) {
    bytes_ -= entries_.back().chunk->bytes.size();
    index_.erase(entries_.back().key);
    entries_.pop_back();
  }
}

}  // namespace dripline::storage
