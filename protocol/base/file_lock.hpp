#pragma once

#include <filesystem>
#include <string_view>

#include "protocol/base/result.hpp"

namespace dripline {

/// Marks that one process (one object, even within a process) uses a thing: an flock on a lock
/// file, which ends with the process in any case. The lock file itself stays; it holds the owner's
/// process id for people.
class FileLock {
 public:
  /// Creates `lock_file` if it does not exist; `thing` is the name in errors.
  /// Errors: Busy (another owner has it; names the thing and the owner's process), Io.
  static Result<FileLock> acquire(const std::filesystem::path& lock_file, std::string_view thing);
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

}  // namespace dripline
