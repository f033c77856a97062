#include "storage/backup/chunk_files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "protocol/base/descriptor.hpp"
#include "protocol/base/durable_file.hpp"
#include "storage/programs/chunk_codec.hpp"

namespace dripline::backup {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUnfinished = ".new";
constexpr std::size_t kPrefix = 2;  ///< digits of the digest that name the sub-folder

tl::unexpected<Error> errno_failure(const fs::path& path) {
  return fail(errno == ENOENT ? Errc::NotFound : Errc::Io, "{}: {}", path.string(),
              std::generic_category().message(errno));
}

Result<void> make_folder(const fs::path& folder) {
  if (::mkdir(folder.c_str(), S_IRWXU) == 0 || errno == EEXIST) return {};
  return errno_failure(folder);
}

}  // namespace

Result<void> write_whole(const fs::path& path, std::span<const std::byte> bytes) {
  const fs::path fresh = path.string() + kUnfinished;
  {
    const Descriptor file(
        ::open(fresh.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, S_IRUSR | S_IWUSR));
    if (!file) return errno_failure(fresh);
    if (!write_all(file.get(), bytes)) return errno_failure(fresh);
    if (::fsync(file.get()) != 0) return errno_failure(fresh);
  }
  if (::rename(fresh.c_str(), path.c_str()) != 0) return errno_failure(path);
  if (!sync_folder(path.parent_path())) return errno_failure(path.parent_path());
  return {};
}

Result<std::vector<std::byte>> read_whole(const fs::path& path, std::uint64_t limit) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat facts {};
  if (!file || ::fstat(file.get(), &facts) != 0) return errno_failure(path);
  const auto size = static_cast<std::uint64_t>(facts.st_size);
  if (size > limit)
    return fail(Errc::LimitExceeded, "{} has {} bytes: at most {}", path.string(), size, limit);
  std::vector<std::byte> bytes(size);
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got = ::read(file.get(), bytes.data() + done, bytes.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return errno_failure(path);
    if (got == 0) return fail(Errc::Io, "{} became shorter while it was read", path.string());
    done += static_cast<std::size_t>(got);
  }
  return bytes;
}

fs::path ChunkFiles::path_of(const Digest& digest) const {
  const std::string hex = digest.hex();
  return folder_ / hex.substr(0, kPrefix) / hex;
}

Result<std::uint64_t> ChunkFiles::put(std::span<const std::byte> plain,
                                      std::vector<Digest>& digests) {
  std::uint64_t added = 0;
  std::error_code ec;
  for (std::span<const std::byte> left = plain; !left.empty();) {
    const auto piece = left.first(std::min<std::size_t>(left.size(), storage::kChunkBytes));
    left = left.subspan(piece.size());
    digests.push_back(sha256(piece));
    const fs::path path = path_of(digests.back());
    if (fs::file_size(path, ec) > 0 && !ec) continue;
    const auto chunk = storage::encode_chunks({}, piece);
    if (auto made = make_folder(path.parent_path()); !made) return fail(made.error());
    if (auto written = write_whole(path, chunk.front().data); !written)
      return fail(written.error());
    added += chunk.front().data.size();
  }
  return added;
}

Result<void> ChunkFiles::sync() const {
  if (!sync_folder(folder_)) return errno_failure(folder_);
  return {};
}

Result<std::vector<std::byte>> ChunkFiles::get(const Digest& digest, std::uint64_t size) const {
  constexpr std::uint64_t kMostBytes = 2 * storage::kChunkBytes;  // compressed; never that long
  const auto data = read_whole(path_of(digest), kMostBytes);
  if (!data && data.error().code == Errc::Io) return fail(data.error());
  if (!data) return fail(Errc::Corrupt, "chunk {}: {}", digest.hex(), data.error().what);
  auto plain = storage::decode_chunk(digest, size, *data);
  if (!plain) return fail(Errc::Corrupt, "chunk {}: {}", digest.hex(), plain.error().what);
  return plain;
}

void ChunkFiles::discard(const Digest& digest) {
  std::error_code ec;
  fs::remove(path_of(digest), ec);
}

Result<std::uint64_t> ChunkFiles::keep_only(const std::set<Digest>& wanted) {
  std::uint64_t freed = 0;
  std::error_code ec;
  std::vector<fs::path> unwanted;
  for (fs::recursive_directory_iterator at(folder_, ec), end; !ec && at != end; at.increment(ec)) {
    if (!at->is_regular_file(ec)) continue;
    const auto digest = parse_digest(at->path().filename().string());
    if (digest && wanted.contains(*digest)) continue;
    // Only what this program has made: a person's file in this folder stays.
    const bool is_ours = digest || at->path().extension() == kUnfinished;
    if (is_ours) unwanted.push_back(at->path());
  }
  if (ec) return fail(Errc::Io, "{}: {}", folder_.string(), ec.message());
  for (const auto& path : unwanted) {
    const auto size = fs::file_size(path, ec);
    if (fs::remove(path, ec)) freed += size;
    if (ec) return fail(Errc::Io, "{}: {}", path.string(), ec.message());
  }
  return freed;
}

}  // namespace dripline::backup
