#pragma once

#include <filesystem>
#include <string>

#include "protocol/base/result.hpp"

namespace dripline::serial {

/// One process per tty: an flock on the open device, which ends with the process, TIOCEXCL, and the
/// lock file of other serial programs (LCK..NAME, with pid and name in it). Where the folder of
/// lock files cannot be written, there is no such file.
class PortLock {
 public:
  static constexpr const char* kFolder = "/run/lock";

  /// `device`: the real path of the open `descriptor`, which must stay open as long as the lock
  /// exists. Errors: Busy (naming the owner), Io.
  static Result<PortLock> take(int descriptor, const std::filesystem::path& device,
                               const std::filesystem::path& folder = kFolder);
  PortLock(PortLock&& other) noexcept;
  PortLock& operator=(PortLock&&) = delete;
  ~PortLock();

 private:
  PortLock(int descriptor, std::filesystem::path file)
      : descriptor_(descriptor), file_(std::move(file)) {}
  int descriptor_;
  std::filesystem::path file_;  ///< empty: none
};

/// The owner of this device, for people: "minicom (pid 312)", or "another process".
std::string owner_of(const std::filesystem::path& device,
                     const std::filesystem::path& folder = PortLock::kFolder);

}  // namespace dripline::serial
