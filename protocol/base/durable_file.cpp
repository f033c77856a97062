#include "protocol/base/durable_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <string>

#include "protocol/base/descriptor.hpp"

namespace dripline {

namespace {

bool write_new(const std::string& path, std::string_view text) {
  const Descriptor file(
      ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR));
  return file && write_all(file.get(), text) && ::fsync(file.get()) == 0;
}

}  // namespace

bool write_all(int file, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t taken = ::write(file, bytes.data(), bytes.size());
    if (taken < 0 && errno == EINTR) continue;
    if (taken < 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(taken));
  }
  return true;
}

bool write_all(int file, std::string_view text) {
  return write_all(file, std::as_bytes(std::span(text)));
}

bool replace_private_file(const std::filesystem::path& path, std::string_view text) {
  const std::string fresh = path.string() + ".new";
  ::unlink(fresh.c_str());  // of a call that was cut off
  const bool is_replaced = write_new(fresh, text) && ::rename(fresh.c_str(), path.c_str()) == 0 &&
                           sync_folder(path.has_parent_path() ? path.parent_path() : ".");
  if (is_replaced) return true;
  const int reason = errno;
  ::unlink(fresh.c_str());
  errno = reason;
  return false;
}

bool sync_folder(const std::filesystem::path& folder) {
  const Descriptor open(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return open && ::fsync(open.get()) == 0;
}

}  // namespace dripline
