#include "protocol/serial/impl/port_lock.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>

#include "protocol/base/descriptor.hpp"

namespace dripline::serial {
namespace {

namespace fs = std::filesystem;

/// The name that minicom, uucp and ser2net use: without /dev/, further slashes as '_'.
fs::path lock_file(const fs::path& device, const fs::path& folder) {
  std::string name = device.string();
  if (name.starts_with("/dev/")) name.erase(0, 5);
  std::replace(name.begin(), name.end(), '/', '_');
  return folder / ("LCK.." + name);
}

bool is_alive(pid_t pid) {
  return ::kill(pid, 0) == 0 || errno == EPERM;
}

std::string name_of(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/comm");
  std::string name;
  std::getline(file, name);
  return name.empty() ? "a process" : name;
}

/// The process in a lock file; nullopt: no file, or the process has ended.
std::optional<pid_t> owner_in_file(const fs::path& path) {
  std::ifstream file(path);
  pid_t pid = 0;
  if (!(file >> pid) || pid <= 0 || !is_alive(pid)) return std::nullopt;
  return pid;
}

/// The process that holds an flock on the device, from the kernel's list.
std::optional<pid_t> owner_of_flock(const fs::path& device) {
  struct stat status {};
  if (::stat(device.c_str(), &status) != 0) return std::nullopt;
  const std::string file =
      fmt::format("{:02x}:{:02x}:{}", major(status.st_dev), minor(status.st_dev), status.st_ino);
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, kind, advisory, access, place;
    pid_t pid = 0;
    words >> number >> kind >> advisory >> access >> pid >> place;
    if (kind == "FLOCK" && place == file && pid > 0) return pid;
  }
  return std::nullopt;
}

/// Writes our lock file in place of one whose owner is gone. False: another process has one.
bool write_lock_file(const fs::path& path, bool& is_written) {
  is_written = false;
  for (int attempt = 0; attempt < 2; ++attempt) {
    const Descriptor file(
        ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644));
    if (file) {
      const std::string text = fmt::format("{:>10} {}\n", ::getpid(), name_of(::getpid()));
      is_written =
          ::write(file.get(), text.data(), text.size()) == static_cast<ssize_t>(text.size());
      if (!is_written) ::unlink(path.c_str());
      return true;
    }
    if (errno != EEXIST) return true;  // no such folder, or no permission to write
    const auto owner = owner_in_file(path);
    // A former channel of this process: the flock shows that it is closed.
    if (owner && *owner != ::getpid()) return false;
    if (::unlink(path.c_str()) != 0) return true;
  }
  return true;
}

}  // namespace

std::string owner_of(const fs::path& device, const fs::path& folder) {
  auto owner = owner_in_file(lock_file(device, folder));
  if (!owner) owner = owner_of_flock(device);
  if (!owner) return "another process";
  return fmt::format("{} (pid {})", name_of(*owner), *owner);
}

Result<PortLock> PortLock::take(int descriptor, const fs::path& device, const fs::path& folder) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK)
      return fail(Errc::Io, "{}: cannot be locked: {}", device.string(),
                  std::generic_category().message(errno));
    return fail(Errc::Busy, "{} is in use by {}", device.string(), owner_of(device, folder));
  }
  const fs::path file = lock_file(device, folder);
  bool is_written = false;
  if (!write_lock_file(file, is_written))
    return fail(Errc::Busy, "{} is in use by {}", device.string(), owner_of(device, folder));
  ::ioctl(descriptor, TIOCEXCL);
  return PortLock(descriptor, is_written ? file : fs::path());
}

PortLock::PortLock(PortLock&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), file_(std::move(other.file_)) {
  other.file_.clear();
}

PortLock::~PortLock() {
  if (descriptor_ >= 0) ::ioctl(descriptor_, TIOCNXCL);
  if (!file_.empty()) ::unlink(file_.c_str());
}

}  // namespace dripline::serial
