#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "storage/cache/cache_folder.hpp"
#include "storage/cache/recent_files.hpp"
#include "storage/content_cache.hpp"

namespace dripline::cache {

struct DiskCacheOptions {
  std::filesystem::path folder;       ///< used by one process; made when it is missing
  std::uint64_t capacity = 0;         ///< bytes on the disk, in whole blocks of kBlock
  std::uint64_t reserve = 256 << 20;  ///< bytes of the disk that are left free
  /// After a failure, before a file is written again.
  std::chrono::milliseconds pause = std::chrono::minutes(1);
  /// Why nothing more can be kept: once, until something was kept again. Any thread; returns soon.
  std::function<void(const std::string& fault)> on_fault = {};
};

/// Program text in files named by their digests, at most so many bytes of them; what was used
/// longest ago goes first. Every file is checked when it is read: a damaged or foreign one is
/// removed, and is as one that was never there. A disk that is full or broken only ends the
/// keeping. Thread-safe; the disk is read and written outside of the lock, which covers renaming,
/// removing and the bookkeeping.
class DiskCache final : public storage::ContentCache {
 public:
  static constexpr std::uint64_t kBlock = 4096;  ///< what a file takes is a multiple of it

  /// Looks through the folder once, without reading its files. Errors: Io (it cannot be made).
  static Result<std::unique_ptr<DiskCache>> open(DiskCacheOptions options);

  std::shared_ptr<const storage::ContentList> find_list(const Digest& content) override;
  void keep_list(const Digest& content, const storage::ContentList& list) override;
  std::optional<std::vector<std::byte>> find_chunk(const Place& place, std::uint64_t size) override;
  void keep_chunk(const Digest& chunk, std::span<const std::byte> frame, Reason reason) override;
  std::uint64_t use_chunk(const Digest& chunk) override;

  struct State {
    std::uint64_t capacity = 0, bytes = 0, files = 0;
    std::uint64_t hits = 0;     ///< chunks that were asked for and were here
    std::uint64_t misses = 0;   ///< that were asked for and came from the database
    std::uint64_t ahead = 0;    ///< that came from the database before they were asked for
    std::uint64_t damaged = 0;  ///< files that were not what their name says
    std::string fault;          ///< why nothing is kept now; empty: it is
  };
  State state() const;

 private:
  explicit DiskCache(DiskCacheOptions options);
  void load(const std::vector<CacheFolder::Found>& found);
  void keep(const FileKey& key, std::span<const std::byte> bytes);
  Result<void> store(const FileKey& key, std::span<const std::byte> bytes);
  bool is_kept_or_paused(const FileKey& key);
  void make_room(std::uint64_t bytes);
  std::uint64_t use(const FileKey& key);
  void drop_damaged(const FileKey& key);
  void note(const Result<void>& stored);

  const DiskCacheOptions options_;
  const CacheFolder folder_;
  mutable std::mutex mutex_;
  RecentFiles files_;
  std::string fault_;
  std::chrono::steady_clock::time_point paused_until_{};
  std::atomic<std::uint64_t> unfinished_ = 0, hits_ = 0, misses_ = 0, ahead_ = 0, damaged_ = 0;
};

}  // namespace dripline::cache
