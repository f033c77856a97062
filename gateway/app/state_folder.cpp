#include "gateway/app/state_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

namespace dripline::gateway {
namespace {

std::string last_error() {
  return std::error_code(errno, std::generic_category()).message();
}

std::string owner_of(int lock) {
  char text[32] = {};
  const ssize_t length = ::pread(lock, text, sizeof text - 1, 0);
  const std::string owner(text, length > 0 ? static_cast<std::size_t>(length) : 0);
  return owner.empty() ? "unknown" : owner.substr(0, owner.find('\n'));
}

}  // namespace

Result<StateFolder> StateFolder::open(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return fail(Errc::Io, "state folder {}: {}", folder.string(), error.message());
  const std::filesystem::path file = folder / "lock";
  const int lock = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (lock < 0) return fail(Errc::Io, "{}: {}", file.string(), last_error());
  StateFolder opened(folder, lock);
  if (::flock(lock, LOCK_EX | LOCK_NB) != 0) {
    return fail(Errc::Busy, "state folder {} is in use by process {}", folder.string(),
                owner_of(lock));
  }
  const std::string pid = std::to_string(::getpid()) + "\n";
  const bool is_written = ::ftruncate(lock, 0) == 0 && ::pwrite(lock, pid.data(), pid.size(), 0) ==
                                                           static_cast<ssize_t>(pid.size());
  // A full disk must not keep the gateway from starting: the number is only for people.
  (void)is_written;
  return opened;
}

StateFolder::StateFolder(StateFolder&& other) noexcept
    : folder_(std::move(other.folder_)), lock_(std::exchange(other.lock_, -1)) {}

StateFolder::~StateFolder() {
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace dripline::gateway
