#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "storage/content_cache.hpp"

/// The file that says what chunks a content has:
///
///     "DNClist1"   8 bytes
///     content      its SHA-256, 32 bytes
///     size         of the content in bytes, 8 bytes, the most significant first
///     chunks       the SHA-256 of each, 32 bytes
///     checksum     SHA-256 of all before it
///
/// Pure; any thread.
namespace dripline::cache {

inline constexpr std::size_t kMostListBytes = std::size_t{64} << 20;  ///< of 512 GiB of text

std::vector<std::byte> to_bytes(const Digest& content, const storage::ContentList& list);

/// nullopt: not one byte more or less, or other, than `to_bytes` writes for `content`.
std::optional<storage::ContentList> read_list(const Digest& content,
                                              std::span<const std::byte> bytes);

}  // namespace dripline::cache
