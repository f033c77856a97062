#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "protocol/base/result.hpp"
#include "storage/cache/recent_files.hpp"

namespace dripline::cache {

/// The files of a cache:
///
///     chunks/3f/3f9c...    a chunk, one zstd frame
///     lists/a0/a07b...     the list of a content's chunks
///     unfinished/17        is being written, or was when the server ended
///
/// Nothing is synchronized: what a power cut spoils is found when it is read. Any thread, but for
/// the same file one at a time.
class CacheFolder {
 public:
  explicit CacheFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  struct Found {
    FileKey key;
    std::uint64_t size = 0;
    std::filesystem::file_time_type used;
  };
  /// Makes what is missing of the folder, removes what is unfinished or not ours, and names the
  /// rest, the one used longest ago first. Contents are not read. Errors: Io.
  Result<std::vector<Found>> begin() const;

  /// All bytes under a name of their own; `publish` gives them their place, `discard` drops them.
  /// Both make a folder that was removed meanwhile. Errors: Io.
  Result<std::filesystem::path> write(std::span<const std::byte> bytes, std::uint64_t number) const;
  Result<void> publish(const std::filesystem::path& unfinished, const FileKey& key) const;
  static void discard(const std::filesystem::path& unfinished);

  /// nullopt: not there, no file, longer than any of ours, or not to be read.
  std::optional<std::vector<std::byte>> read(const FileKey& key) const;
  void remove(const FileKey& key) const;
  /// Used now.
  void touch(const FileKey& key) const;
  /// Bytes that the disk has left; nullopt: it does not tell.
  std::optional<std::uint64_t> free_bytes() const;

  const std::filesystem::path& path() const { return folder_; }

 private:
  Result<void> make(const std::filesystem::path& part) const;
  std::filesystem::path path_of(const FileKey& key) const;
  void find(FileKey::Kind kind, std::vector<Found>& found) const;

  const std::filesystem::path folder_;
};

}  // namespace dripline::cache
