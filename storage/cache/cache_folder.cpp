#include "storage/cache/cache_folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <algorithm>
#include <cerrno>
#include <system_error>

#include "protocol/base/descriptor.hpp"
#include "protocol/base/durable_file.hpp"
#include "storage/cache/list_file.hpp"
#include "storage/programs/chunk_codec.hpp"

namespace dripline::cache {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUnfinished = "unfinished";
/// More than any zstd frame of a chunk.
constexpr std::uint64_t kMostFrameBytes = storage::kChunkBytes + (16 << 10);
constexpr std::size_t kPrefix = 2;  ///< digits of the digest that name the sub-folder

tl::unexpected<Error> errno_failure(const fs::path& path) {
  return fail(Errc::Io, "{}: {}", path.string(), std::generic_category().message(errno));
}

const char* folder_of(FileKey::Kind kind) {
  return kind == FileKey::Kind::Chunk ? "chunks" : "lists";
}

std::uint64_t limit_of(FileKey::Kind kind) {
  return kind == FileKey::Kind::Chunk ? kMostFrameBytes : kMostListBytes;
}

/// A name in a sub-folder that we would have given.
std::optional<Digest> digest_of(const fs::path& file) {
  const std::string name = file.filename().string();
  const auto digest = parse_digest(name);
  if (!digest || digest->hex() != name) return std::nullopt;
  if (file.parent_path().filename().string() != name.substr(0, kPrefix)) return std::nullopt;
  return *digest;
}

/// A folder of another's stays; everything in ours that is no folder goes.
void remove_file(const fs::path& path) {
  std::error_code ec;
  if (!fs::is_directory(fs::symlink_status(path, ec))) fs::remove(path, ec);
}

}  // namespace

fs::path CacheFolder::path_of(const FileKey& key) const {
  const std::string name = key.digest.hex();
  return folder_ / folder_of(key.kind) / name.substr(0, kPrefix) / name;
}

void CacheFolder::find(FileKey::Kind kind, std::vector<Found>& found) const {
  std::error_code ec;
  for (const auto& sub : fs::directory_iterator(folder_ / folder_of(kind), ec)) {
    if (!fs::is_directory(sub.symlink_status(ec))) {
      remove_file(sub.path());
      continue;
    }
    for (const auto& entry : fs::directory_iterator(sub.path(), ec)) {
      const auto digest = digest_of(entry.path());
      const bool is_file = fs::is_regular_file(entry.symlink_status(ec));
      const std::uint64_t size = is_file ? entry.file_size(ec) : 0;
      const auto used = is_file ? entry.last_write_time(ec) : fs::file_time_type::min();
      if (digest && is_file && !ec && size > 0 && size <= limit_of(kind)) {
        found.push_back({{kind, *digest}, size, used});
      } else {
        remove_file(entry.path());
      }
    }
  }
}

/// Those above it are there already, or are made as well.
Result<void> CacheFolder::make(const fs::path& part) const {
  const auto make_one = [](const fs::path& path) -> Result<void> {
    if (::mkdir(path.c_str(), S_IRWXU) != 0 && errno != EEXIST) return errno_failure(path);
    return {};
  };
  fs::path path = folder_;
  auto made = make_one(path);
  for (auto name = part.begin(); made && name != part.end(); ++name) made = make_one(path /= *name);
  return made;
}

Result<std::vector<CacheFolder::Found>> CacheFolder::begin() const {
  for (const char* name : {"chunks", "lists", kUnfinished}) {
    if (auto made = make(name); !made) return fail(made.error());
    const fs::path path = folder_ / name;
    std::error_code ec;
    if (!fs::is_directory(path, ec)) return fail(Errc::Io, "{} is no folder", path.string());
  }
  std::error_code ec;
  for (const auto& left : fs::directory_iterator(folder_ / kUnfinished, ec))
    remove_file(left.path());
  std::vector<Found> found;
  find(FileKey::Kind::Chunk, found);
  find(FileKey::Kind::List, found);
  std::ranges::sort(found, {}, &Found::used);
  return found;
}

Result<fs::path> CacheFolder::write(std::span<const std::byte> bytes, std::uint64_t number) const {
  const fs::path path = folder_ / kUnfinished / std::to_string(number);
  const auto open_file = [&path] {
    return Descriptor(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC,
                             S_IRUSR | S_IWUSR));
  };
  Descriptor file = open_file();
  if (!file && errno == ENOENT) {  // the folder was removed
    if (auto made = make(kUnfinished); !made) return fail(made.error());
    file = open_file();
  }
  if (!file) return errno_failure(path);
  if (write_all(file.get(), bytes)) return path;
  auto failure = errno_failure(path);
  discard(path);
  return failure;
}

Result<void> CacheFolder::publish(const fs::path& unfinished, const FileKey& key) const {
  const fs::path path = path_of(key);
  if (::rename(unfinished.c_str(), path.c_str()) == 0) return {};
  if (errno != ENOENT) return errno_failure(path);
  // The first of its sub-folder; or the folder was removed.
  if (auto made = make(path.parent_path().lexically_relative(folder_)); !made) return made;
  if (::rename(unfinished.c_str(), path.c_str()) == 0) return {};
  return errno_failure(path);
}

void CacheFolder::discard(const fs::path& unfinished) {
  ::unlink(unfinished.c_str());
}

std::optional<std::vector<std::byte>> CacheFolder::read(const FileKey& key) const {
  // A pipe in a file's place keeps no one waiting.
  const Descriptor file(
      ::open(path_of(key).c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat facts {};
  if (!file || ::fstat(file.get(), &facts) != 0 || !S_ISREG(facts.st_mode)) return std::nullopt;
  const auto size = static_cast<std::uint64_t>(facts.st_size);
  if (size > limit_of(key.kind)) return std::nullopt;
  std::vector<std::byte> bytes(size);
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t got = ::read(file.get(), bytes.data() + done, bytes.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return std::nullopt;
    done += static_cast<std::size_t>(got);
  }
  return bytes;
}

void CacheFolder::remove(const FileKey& key) const {
  remove_file(path_of(key));
}

void CacheFolder::touch(const FileKey& key) const {
  ::utimensat(AT_FDCWD, path_of(key).c_str(), nullptr, AT_SYMLINK_NOFOLLOW);
}

std::optional<std::uint64_t> CacheFolder::free_bytes() const {
  struct statvfs disk {};
  if (::statvfs(folder_.c_str(), &disk) != 0) return std::nullopt;
  return std::uint64_t{disk.f_bavail} * disk.f_frsize;
}

}  // namespace dripline::cache
