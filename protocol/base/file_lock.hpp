#pragma once

#include <filesystem>
#include <string_view>

#include "protocol/base/result.hpp"

namespace dripline {

/// Says that one process (one object, even within a process) uses a thing: an flock on a lock file,
/// gone with the process however it ends. The lock file itself stays; it holds the owner's process
/// id, for people.
class FileLock {
 public:
  /// `lock_file` is created when there is none; `thing` is what errors call the locked thing.
  /// Errors: Busy (someone else holds it; names the thing and the owner's process), Io.
  static Result<FileLock> acquire(const std::filesystem::path& lock_file, std::string_view thing);
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

}  // namespace dripline
