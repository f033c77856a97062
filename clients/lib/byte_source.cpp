#include "clients/lib/byte_source.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <system_error>
#include <utility>

namespace dripline::client {

Result<FileSource> FileSource::open(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    return fail(Errc::Io, "file {} cannot be read: {}", path,
                std::generic_category().message(errno));
  }
  struct stat status {};
  FileSource source(path, descriptor, 0);
  if (::fstat(descriptor, &status) != 0) {
    return fail(Errc::Io, "file {} cannot be read: {}", path,
                std::generic_category().message(errno));
  }
  if (!S_ISREG(status.st_mode)) {
    return fail(Errc::Unsupported, "{} is not a regular file, as a push that can resume needs",
                path);
  }
  source.size_ = static_cast<std::uint64_t>(status.st_size);
  return source;
}

FileSource::FileSource(std::string path, int descriptor, std::uint64_t size)
    : path_(std::move(path)), descriptor_(descriptor), size_(size) {}

FileSource::FileSource(FileSource&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_) {}

FileSource::~FileSource() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Result<void> FileSource::read(std::uint64_t offset, std::span<char> into) {
  while (!into.empty()) {
    const auto got = ::pread(descriptor_, into.data(), into.size(), static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      return fail(Errc::Io, "file {} cannot be read: {}", path_,
                  std::generic_category().message(errno));
    if (got == 0) {
      return fail(Errc::Io, "file {} ended at byte {}, it had {} when the push began", path_,
                  offset, size_);
    }
    offset += static_cast<std::uint64_t>(got);
    into = into.subspan(static_cast<std::size_t>(got));
  }
  return {};
}

}  // namespace dripline::client
