#include "protocol/base/durable_file.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <cerrno>

#include "protocol/base/descriptor.hpp"

namespace dripline {

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

bool sync_folder(const std::filesystem::path& folder) {
  const Descriptor open(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return open && ::fsync(open.get()) == 0;
}

}  // namespace dripline
