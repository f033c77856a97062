#include "protocol/base/descriptor.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

namespace dripline {
namespace {

std::string last_error() {
  return std::generic_category().message(errno);
}

std::string owner_of(int lock) {
  char text[32] = {};
  const ssize_t length = ::pread(lock, text, sizeof text - 1, 0);
  const std::string owner(text, length > 0 ? static_cast<std::size_t>(length) : 0);
  return owner.empty() ? "unknown" : owner.substr(0, owner.find('\n'));
}

void write_owner(int lock) {
  const std::string pid = std::to_string(::getpid()) + "\n";
  const bool is_written = ::ftruncate(lock, 0) == 0 && ::pwrite(lock, pid.data(), pid.size(), 0) ==
                                                           static_cast<ssize_t>(pid.size());
  // A full disk must not prevent a start: the number is only for people.
  (void)is_written;
}

}  // namespace

Result<FileLock> FileLock::acquire(const std::filesystem::path& lock_file, std::string_view thing) {
  const int descriptor = ::open(lock_file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor < 0) return fail(Errc::Io, "{}: {}", lock_file.string(), last_error());
  FileLock lock(descriptor);
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) {
    write_owner(descriptor);
    return lock;
  }
  if (errno != EWOULDBLOCK) {
    return fail(Errc::Io, "locking {}: {}", lock_file.string(), last_error());
  }
  return fail(Errc::Busy, "{} is in use by process {} (it holds {})", thing, owner_of(descriptor),
              lock_file.string());
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace dripline
