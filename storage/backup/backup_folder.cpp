#include "storage/backup/backup_folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <algorithm>
#include <fstream>
#include <set>
#include <system_error>

#include "protocol/base/durable_file.hpp"
#include "protocol/base/private_folder.hpp"
#include "storage/programs/chunk_codec.hpp"
#include "storage/sqlite_store.hpp"

namespace dripline::backup {
namespace {

namespace fs = std::filesystem;

constexpr const char* kManifest = ".json";
constexpr const char* kVerified = ".verified";
constexpr const char* kCopy = "database.copy";
/// 27 MB are the chunks of 100 GB.
constexpr std::uint64_t kMaxManifest = 1ULL << 30;

tl::unexpected<Error> ended() {
  return fail(Errc::Conflict, "the work was ended before it was complete");
}

/// Removed with its scope.
struct ScratchFile {
  explicit ScratchFile(fs::path file) : path(std::move(file)) { remove(); }
  ~ScratchFile() { remove(); }
  void remove() const {
    std::error_code ec;
    for (const char* suffix : {"", "-wal", "-shm", "-journal"})
      fs::remove(path.string() + suffix, ec);
  }
  const fs::path path;
};

std::string id_of(UtcTime time) {
  std::string text = to_iso8601(std::chrono::floor<std::chrono::seconds>(time));
  text.resize(text.find_first_of(".Z"));
  std::erase_if(text, [](char c) { return c == '-' || c == ':'; });
  return text + "Z";
}

bool is_id(std::string_view text) {
  constexpr std::size_t kLength = 16;
  return text.size() == kLength && text.back() == 'Z' &&
         std::ranges::all_of(text.substr(0, kLength - 1),
                             [](char c) { return (c >= '0' && c <= '9') || c == 'T'; });
}

Result<void> check_empty(const fs::path& folder) {
  std::error_code ec;
  if (!fs::exists(folder, ec)) return {};
  if (fs::is_directory(folder, ec) && fs::is_empty(folder, ec)) return {};
  return fail(Errc::Busy, "{} is not empty: a backup is restored into a new folder",
              folder.string());
}

}  // namespace

std::string_view to_string(Phase phase) {
  switch (phase) {
    case Phase::Copying:
      return "copying";
    case Phase::Checking:
      return "checking";
    case Phase::Storing:
      return "storing";
    case Phase::Verifying:
      return "verifying";
    case Phase::Restoring:
      return "restoring";
  }
  return "copying";
}

BackupFolder::BackupFolder(fs::path path, FileLock lock)
    : path_(std::move(path)), lock_(std::move(lock)), chunks_(path_ / "chunks") {}

Result<BackupFolder> BackupFolder::open(const fs::path& path) {
  auto made = make_private_folder(path, {"chunks"});
  if (made) made = make_private_subfolder(path / "chunks");
  if (!made) return fail(made.error().code, "backups {}", made.error().what);
  auto lock = FileLock::acquire(path / "lock", fmt::format("the backups in {}", path.string()));
  if (!lock) return fail(lock.error());
  return BackupFolder(fs::absolute(path), *std::move(lock));
}

fs::path BackupFolder::manifest_file(const std::string& id) const {
  return path_ / (id + kManifest);
}

fs::path BackupFolder::verified_file(const std::string& id) const {
  return path_ / (id + kVerified);
}

Backup BackupFolder::described(const std::string& id, const Manifest& manifest) const {
  Backup backup{.id = id,
                .made = manifest.made,
                .made_by = manifest.made_by,
                .database = manifest.database,
                .size = manifest.size(),
                .added = manifest.added};
  std::ifstream file(verified_file(id));
  if (std::int64_t time = 0; file >> time)
    backup.verified = UtcTime(std::chrono::microseconds(time));
  return backup;
}

Result<Manifest> BackupFolder::manifest(const std::string& id) const {
  if (!is_id(id)) return fail(Errc::NotFound, "there is no backup '{}'", id);
  const auto bytes = read_whole(manifest_file(id), kMaxManifest);
  if (!bytes && bytes.error().code == Errc::NotFound)
    return fail(Errc::NotFound, "there is no backup '{}'", id);
  if (!bytes) return fail(bytes.error());
  auto manifest = parse_manifest({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
  if (!manifest) return fail(manifest.error().code, "backup {}: {}", id, manifest.error().what);
  return manifest;
}

Result<KeptFile> BackupFolder::store(const fs::path& file, std::string name, std::uint64_t& added,
                                     const Watch& watch) {
  constexpr std::size_t kAtOnce = 16 * storage::kChunkBytes;
  KeptFile kept{.name = std::move(name), .size = 0, .chunks = {}};
  std::error_code ec;
  const std::uint64_t total = fs::file_size(file, ec);
  std::ifstream in(file, std::ios::binary);
  if (ec || !in) return fail(Errc::Io, "{} cannot be read", file.string());
  std::vector<std::byte> bytes(kAtOnce);
  while (kept.size < total) {
    const auto wanted = std::min<std::uint64_t>(bytes.size(), total - kept.size);
    if (!in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(wanted)))
      return fail(Errc::Io, "{} cannot be read at {}", file.string(), kept.size);
    const auto stored = chunks_.put(std::span(bytes).first(wanted), kept.chunks);
    if (!stored) return fail(stored.error());
    added += *stored;
    kept.size += wanted;
    if (!watch(Phase::Storing, kept.size, total)) return ended();
  }
  return kept;
}

Result<Backup> BackupFolder::make(const Source& source, UtcTime now, const Watch& watch) {
  Manifest manifest{
      .made = now, .made_by = source.made_by, .database = {}, .added = 0, .files = {}};
  const std::string id = id_of(now);
  std::error_code ec;
  if (fs::exists(manifest_file(id), ec))
    return fail(Errc::Conflict, "backup {} exists already: one a second", id);
  const ScratchFile copy(path_ / kCopy);
  const auto copied = source.copy(copy.path, [&](std::uint64_t done, std::uint64_t total) {
    return watch(Phase::Copying, done, total);
  });
  if (!copied) return fail(copied.error());
  if (!*copied || !watch(Phase::Checking, 0, 0)) return ended();
  const auto identity = storage::check_copy(copy.path);
  if (!identity) return fail(identity.error());
  manifest.database = *identity;
  auto database = store(copy.path, source.database, manifest.added, watch);
  if (!database) return fail(database.error());
  manifest.files.push_back(*std::move(database));
  for (const auto& name : source.files) {
    if (!fs::exists(source.folder / name, ec)) continue;
    auto file = store(source.folder / name, name, manifest.added, watch);
    if (!file) return fail(file.error());
    manifest.files.push_back(*std::move(file));
  }
  if (auto synced = chunks_.sync(); !synced) return fail(synced.error());
  const std::string text = to_text(manifest);
  if (auto written = write_whole(manifest_file(id), std::as_bytes(std::span(text))); !written)
    return fail(written.error());
  return described(id, manifest);
}

Result<BackupFolder::List> BackupFolder::list() const {
  List list;
  std::error_code ec;
  for (fs::directory_iterator at(path_, ec), end; !ec && at != end; at.increment(ec)) {
    const std::string id = at->path().stem().string();
    if (at->path().extension() != kManifest || !is_id(id)) continue;
    const auto found = manifest(id);
    if (found) {
      list.backups.push_back(described(id, *found));
    } else {
      list.damaged.push_back(found.error().what);
    }
  }
  if (ec) return fail(Errc::Io, "{}: {}", path_.string(), ec.message());
  std::ranges::sort(list.backups, {}, &Backup::id);
  std::ranges::sort(list.damaged);
  return list;
}

Result<void> BackupFolder::verify(const std::string& id, UtcTime now, const Watch& watch) {
  const auto found = manifest(id);
  if (!found) return fail(found.error());
  const std::uint64_t total = found->size();
  std::uint64_t done = 0;
  std::size_t damaged = 0;
  Error first;
  for (const auto& file : found->files) {
    std::uint64_t left = file.size;
    for (const auto& digest : file.chunks) {
      const std::uint64_t size = std::min(left, storage::kChunkBytes);
      left -= size;
      if (const auto bytes = chunks_.get(digest, size); !bytes) {
        if (bytes.error().code != Errc::Corrupt) return fail(bytes.error());
        if (damaged++ == 0) first = bytes.error();
        chunks_.discard(digest);
      }
      done += size;
      if (!watch(Phase::Verifying, done, total)) return ended();
    }
  }
  if (damaged == 0) {
    const std::string time = fmt::format("{}\n", now.time_since_epoch().count());
    return write_whole(verified_file(id), std::as_bytes(std::span(time)));
  }
  std::error_code ec;
  fs::remove(verified_file(id), ec);
  return fail(Errc::Corrupt, "backup {}: {} of its chunks are damaged or missing, the first: {}",
              id, damaged, first.what);
}

Result<void> BackupFolder::write_file(const KeptFile& file, const fs::path& folder,
                                      const std::function<bool(std::uint64_t)>& proceed) const {
  const fs::path path = folder / file.name;
  const Descriptor out(
      ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR));
  std::uint64_t left = file.size;
  for (const auto& digest : file.chunks) {
    const auto bytes = chunks_.get(digest, std::min(left, storage::kChunkBytes));
    if (!bytes) return fail(bytes.error());
    left -= bytes->size();
    std::size_t written = 0;
    while (out && written < bytes->size()) {
      const ssize_t taken = ::write(out.get(), bytes->data() + written, bytes->size() - written);
      if (taken < 0)
        return fail(Errc::Io, "{}: {}", path.string(), std::generic_category().message(errno));
      written += static_cast<std::size_t>(taken);
    }
    if (!proceed(bytes->size())) return ended();
  }
  if (!out || ::fsync(out.get()) != 0)
    return fail(Errc::Io, "{}: {}", path.string(), std::generic_category().message(errno));
  return {};
}

Result<void> BackupFolder::restore(const std::string& id, const fs::path& folder,
                                   const Watch& watch) {
  const auto found = manifest(id);
  if (!found) return fail(found.error());
  if (auto empty = check_empty(folder); !empty) return empty;
  // Beside the folder, so that it appears whole or not at all.
  const fs::path fresh = fs::absolute(folder).lexically_normal().string() + ".restoring";
  std::error_code ec;
  fs::remove_all(fresh, ec);
  if (const auto made = make_private_subfolder(fresh); !made) return fail(made.error());
  const std::uint64_t total = found->size();
  std::uint64_t done = 0;
  const auto restored = [&]() -> Result<void> {
    for (const auto& file : found->files) {
      auto written = write_file(file, fresh, [&](std::uint64_t bytes) {
        return watch(Phase::Restoring, done += bytes, total);
      });
      if (!written) return written;
    }
    if (found->files.empty()) return fail(Errc::Corrupt, "backup {} holds no file", id);
    const auto identity = storage::check_copy(fresh / found->files.front().name);
    if (!identity) return fail(identity.error());
    if (*identity == found->database) return {};
    return fail(Errc::Corrupt, "backup {} holds another database than it names", id);
  }();
  if (!restored) {
    fs::remove_all(fresh, ec);
    return restored;
  }
  const auto not_on_disk = [](const fs::path& path) {
    return fail(Errc::Io, "{}: {}", path.string(), std::generic_category().message(errno));
  };
  if (!sync_folder(fresh)) return not_on_disk(fresh);
  fs::remove(folder, ec);  // an empty one
  fs::rename(fresh, folder, ec);
  if (ec) return fail(Errc::Io, "{}: {}", folder.string(), ec.message());
  if (!sync_folder(fresh.parent_path())) return not_on_disk(fresh.parent_path());
  return {};
}

Result<void> BackupFolder::remove(const std::string& id) {
  std::error_code ec;
  if (is_id(id) && fs::remove(manifest_file(id), ec)) {
    fs::remove(verified_file(id), ec);
    return {};
  }
  if (ec) return fail(Errc::Io, "{}: {}", manifest_file(id).string(), ec.message());
  return fail(Errc::NotFound, "there is no backup '{}'", id);
}

const Backup* newest(std::span<const Backup> backups, UtcTime now) {
  const auto end = std::ranges::find_if(backups, [&](const Backup& one) { return one.made > now; });
  return end == backups.begin() ? nullptr : &*std::prev(end);
}

Result<BackupFolder::Pruned> BackupFolder::prune(const Retention& retention, UtcTime now) {
  const auto listed = list();
  if (!listed) return fail(listed.error());
  std::vector<UtcTime> made;
  for (const auto& backup : listed->backups) made.push_back(backup.made);
  // After so long a pause all would go at once, or the clock is wrong: the next one decides.
  constexpr std::chrono::weeks kLongPause{26};
  const auto past = std::ranges::count_if(made, [&](UtcTime time) { return time <= now; });
  if (past >= 2 && now - made[static_cast<std::size_t>(past) - 2] > kLongPause) return Pruned{};
  const auto out = expired(made, retention, now);
  Pruned pruned;
  std::set<Digest> wanted;
  for (const auto& backup : listed->backups) {
    if (out.contains(backup.made)) {
      if (auto removed = remove(backup.id); !removed) return fail(removed.error());
      ++pruned.backups;
      continue;
    }
    const auto kept = manifest(backup.id);
    if (!kept) return fail(kept.error());
    for (const auto& file : kept->files) wanted.insert(file.chunks.begin(), file.chunks.end());
  }
  if (!listed->damaged.empty())
    return fail(Errc::Corrupt, "no space is freed in {}: {}", path_.string(),
                listed->damaged.front());
  const auto freed = chunks_.keep_only(wanted);
  if (!freed) return fail(freed.error());
  pruned.bytes = *freed;
  return pruned;
}

}  // namespace dripline::backup
