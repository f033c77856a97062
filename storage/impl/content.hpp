#pragma once

#include <optional>
#include <string>

#include "storage/impl/chunk_codec.hpp"
#include "storage/sqlite/query.hpp"

/// Rows of content, content_chunk and chunk. Functions that write run inside the caller's
/// transaction.
namespace dripline::storage {

struct ContentRow {
  std::int64_t id = 0;
  std::uint64_t size = 0;
};

Digest read_digest(const sqlite::Statement& row, int column);

Result<std::optional<ContentRow>> find_content(sqlite::Database& database, const Digest& digest);

/// A new content without bytes; returns its id.
Result<std::int64_t> create_content(sqlite::Database& database);

/// Puts the chunks at `position`, `position` + 1 ...; the first one replaces what was there.
/// A damaged chunk of the same digest is healed.
Result<void> put_chunks(sqlite::Database& database, std::int64_t content, std::uint64_t position,
                        std::span<const EncodedChunk> chunks);

/// Deletes the content and those of its chunks that no other content has.
Result<void> drop_content(sqlite::Database& database, std::int64_t content);

/// `content` gets the chunks of `replacement`, which is deleted.
Result<void> replace_content(sqlite::Database& database, std::int64_t content,
                             std::int64_t replacement);

/// One chunk, checked: it is whole, and the one that was stored at this place (`expected`, if
/// given). `label` names the content in errors. Errors: Corrupt (also: missing).
Result<std::vector<std::byte>> load_chunk(sqlite::Database& database, std::int64_t content,
                                          std::uint64_t position, std::string_view label,
                                          const Digest* expected = nullptr);

/// A range of bytes, checked chunk by chunk; ends at the content's end.
Result<std::vector<std::byte>> load_range(sqlite::Database& database, const ContentRow& content,
                                          std::uint64_t offset, std::uint64_t length,
                                          std::string_view label);

}  // namespace dripline::storage
