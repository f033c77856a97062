#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>
#include <span>
#include <vector>

#include "protocol/base/digest.hpp"

namespace dripline::backup {

/// Writes a file that is whole and on disk, or not there: also after a kill or a power cut midway.
/// Errors: Io.
Result<void> write_whole(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Errors: NotFound, Io, LimitExceeded (longer than `limit`).
Result<std::vector<std::byte>> read_whole(const std::filesystem::path& path, std::uint64_t limit);

/// Chunks as files of a folder, each named by its digest and compressed. One thread at a time.
class ChunkFiles {
 public:
  explicit ChunkFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Stores those that are not there. Returns the bytes that were written. Errors: Io.
  Result<std::uint64_t> put(std::span<const std::byte> plain, std::vector<Digest>& digests);
  /// After `put`, before its digests are named anywhere: the sub-folders' names are on disk too.
  /// Errors: Io.
  Result<void> sync() const;
  /// The plain bytes, checked. Errors: Corrupt (also: missing), Io.
  Result<std::vector<std::byte>> get(const Digest& digest, std::uint64_t size) const;
  /// Removes a damaged one, so that the next backup stores it again.
  void discard(const Digest& digest);
  /// Removes all but `wanted`, and what a kill has left. Returns the bytes that became free.
  Result<std::uint64_t> keep_only(const std::set<Digest>& wanted);

 private:
  std::filesystem::path path_of(const Digest& digest) const;
  std::filesystem::path folder_;
};

}  // namespace dripline::backup
