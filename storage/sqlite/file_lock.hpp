#pragma once

#include <filesystem>

#include "protocol/base/result.hpp"

namespace dripline::storage::sqlite {

/// Says that one process (one object, even within a process) uses a file: an flock on
/// `FILE.lock` beside it, gone with the process however it ends. The lock file itself stays.
class FileLock {
 public:
  /// Errors: Busy (someone else holds it; names the file), Io.
  static Result<FileLock> acquire(const std::filesystem::path& file);
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

}  // namespace dripline::storage::sqlite
