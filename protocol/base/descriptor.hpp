#pragma once

#include <unistd.h>
#include <filesystem>
#include <string_view>
#include <utility>

#include "protocol/base/result.hpp"

namespace dripline {

/// Owns a file descriptor; -1: none.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int get() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }

 private:
  int number_ = -1;
};

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
