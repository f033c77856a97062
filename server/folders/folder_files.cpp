#include "server/folders/folder_files.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <pwd.h>
#include <signal.h>
#include <stdio.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

#include "protocol/base/durable_file.hpp"

namespace dripline::folders {
namespace {

constexpr std::size_t kPiece = 256 * 1024;
constexpr mode_t kFolderMode = 0770;
constexpr mode_t kReasonMode = 0660;

std::string system_words(int error) {
  std::array<char, 128> words{};
  return ::strerror_r(error, words.data(), words.size());
}

Error system_error(const std::string& what, int error) {
  const bool is_denied = error == EACCES || error == EPERM || error == EROFS;
  // Another computer that has the file of a share open.
  const bool is_passing = error == EBUSY || error == ETXTBSY || error == EAGAIN || error == ESTALE;
  const auto code = error == ENOENT   ? Errc::NotFound
                    : error == EEXIST ? Errc::Conflict
                    : is_denied       ? Errc::Denied
                    : is_passing      ? Errc::Busy
                                      : Errc::Io;
  return {code, fmt::format("{}: {}", what, system_words(error))};
}

std::string_view words_of(mode_t mode) {
  if (S_ISLNK(mode)) return "a symbolic link";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  if (S_ISDIR(mode)) return "a folder";
  return "a device";
}

Entry entry_of(const std::string& name, const struct stat& facts) {
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  Entry entry;
  entry.name = name;
  entry.size = static_cast<std::uint64_t>(facts.st_size);
  entry.changed_ns = facts.st_mtim.tv_sec * kNanoseconds + facts.st_mtim.tv_nsec;
  if (S_ISREG(facts.st_mode)) return entry;
  entry.kind = S_ISDIR(facts.st_mode) ? Entry::Kind::Folder : Entry::Kind::Other;
  entry.what = words_of(facts.st_mode);
  return entry;
}

/// A lease for reading is refused while the file is open for writing. It needs the file's owner or
/// a privilege, and a file system that has leases; where it is not given nothing is known.
bool is_open_for_writing(int file) {
  // Who opens the file within the lease's short life would make the kernel send SIGIO, which ends
  // the process; SIGURG does nothing.
  (void)::fcntl(file, F_SETSIG, SIGURG);
  if (::fcntl(file, F_SETLEASE, F_RDLCK) != 0) return errno == EAGAIN;
  (void)::fcntl(file, F_SETLEASE, F_UNLCK);
  return false;
}

/// A file without a name, on the disk of the server's own data.
Result<Descriptor> open_spool(const std::filesystem::path& folder) {
  Descriptor file(::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, S_IRUSR | S_IWUSR));
  if (file) return file;
  std::string pattern = (folder / "folder-file-XXXXXX").string();
  Descriptor named(::mkostemp(pattern.data(), O_CLOEXEC));
  if (!named) return fail(system_error(folder.string(), errno));
  ::unlink(pattern.c_str());
  return named;
}

Result<FileCopy> copy_bytes(int from, Descriptor to, const std::string& name,
                            std::uint64_t max_bytes) {
  std::vector<char> piece(kPiece);
  Sha256 digest;
  std::uint64_t size = 0;
  for (;;) {
    const auto got = ::read(from, piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return fail(system_error(name, errno));
    if (got == 0) return FileCopy(std::move(to), size, digest.digest());
    const auto bytes = static_cast<std::size_t>(got);
    size += bytes;
    if (size > max_bytes)
      return fail(Errc::LimitExceeded, "it has more than {} bytes, the folder's limit", max_bytes);
    const std::string_view text(piece.data(), bytes);
    digest.update(text);
    if (!write_all(to.get(), text)) return fail(system_error("a copy cannot be written", errno));
  }
}

std::string account_name(uid_t number) {
  std::array<char, 4096> room{};
  passwd account{};
  passwd* found = nullptr;
  if (::getpwuid_r(number, &account, room.data(), room.size(), &found) != 0) return {};
  return found == nullptr ? std::string() : std::string(found->pw_name);
}

/// "O1.nc", "O1.2.nc", "O1.3.nc" ...
std::string numbered(const std::string& name, unsigned number) {
  if (number == 1) return name;
  const auto dot = name.rfind('.');
  const bool has_extension = dot != std::string::npos && dot > 0;
  return fmt::format("{}.{}{}", has_extension ? name.substr(0, dot) : name, number,
                     has_extension ? name.substr(dot) : "");
}

/// Made where it is missing; never the target of a symbolic link.
Result<Descriptor> open_subfolder(int parent, const std::string& name) {
  if (::mkdirat(parent, name.c_str(), kFolderMode) != 0 && errno != EEXIST)
    return fail(system_error(name, errno));
  Descriptor folder(
      ::openat(parent, name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  if (!folder) return fail(system_error(name, errno));
  return folder;
}

}  // namespace

FileCopy::FileCopy(Descriptor file, std::uint64_t size, const Digest& digest)
    : file_(std::move(file)), size_(size), digest_(digest) {}

FileCopy::FileCopy(FileCopy&& other) noexcept
    : file_(std::move(other.file_)),
      size_(std::exchange(other.size_, 0)),
      digest_(other.digest_),
      owner_(std::move(other.owner_)),
      bytes_(std::exchange(other.bytes_, nullptr)) {}

FileCopy::~FileCopy() {
  if (bytes_ != nullptr) ::munmap(const_cast<char*>(bytes_), size_);
}

Result<void> FileCopy::map() {
  if (size_ == 0 || bytes_ != nullptr) return {};
  void* const mapped = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file_.get(), 0);
  if (mapped == MAP_FAILED) return fail(system_error("a copy cannot be mapped", errno));
  bytes_ = static_cast<const char*>(mapped);
  return {};
}

Result<FolderFiles> FolderFiles::open(const FolderSettings& settings) {
  Descriptor folder(::open(settings.path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder) return fail(system_error(settings.path.string(), errno));
  FolderFiles files(std::move(folder));
  for (Subfolder* sub : {&files.done_, &files.failed_}) {
    sub->name = sub == &files.done_ ? settings.done : settings.failed;
    auto opened = open_subfolder(files.folder_.get(), sub->name);
    if (!opened)
      return fail(opened.error().code, "{}/{}", settings.path.string(), opened.error().what);
    sub->folder = *std::move(opened);
  }
  return files;
}

FolderFiles::Place FolderFiles::place_of(const std::string& target) const {
  const auto slash = target.find('/');
  if (slash == std::string::npos) return {folder_.get(), target};
  const bool is_done = target.substr(0, slash) == done_.name;
  return {(is_done ? done_ : failed_).folder.get(), target.substr(slash + 1)};
}

Result<std::vector<Entry>> FolderFiles::list() const {
  const int own = ::openat(folder_.get(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (own < 0) return fail(system_error("the folder cannot be read", errno));
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(::fdopendir(own), &::closedir);
  if (!folder) return fail(system_error("the folder cannot be read", errno));
  std::vector<Entry> entries;
  for (;;) {
    errno = 0;
    const dirent* const found = ::readdir(folder.get());  // NOLINT(concurrency-mt-unsafe): own DIR
    if (found == nullptr && errno != 0)
      return fail(system_error("the folder cannot be read", errno));
    if (found == nullptr) break;
    const std::string name = found->d_name;
    if (name == "." || name == ".." || name == done_.name || name == failed_.name) continue;
    auto entry = look_at(name);
    if (!entry) continue;  // gone already
    if (entries.size() >= kMaxEntries)
      return fail(Errc::LimitExceeded, "the folder has more than {} entries", kMaxEntries);
    entries.push_back(*std::move(entry));
  }
  std::ranges::sort(entries, {}, [](const Entry& e) { return std::pair(e.changed_ns, e.name); });
  return entries;
}

Result<Entry> FolderFiles::look_at(const std::string& name) const {
  struct stat facts {};
  if (::fstatat(folder_.get(), name.c_str(), &facts, AT_SYMLINK_NOFOLLOW) != 0)
    return fail(system_error(name, errno));
  return entry_of(name, facts);
}

Result<FileCopy> FolderFiles::copy(const Entry& seen, const std::filesystem::path& spool,
                                   std::uint64_t max_bytes) const {
  if (seen.size > max_bytes) {
    return fail(Errc::LimitExceeded, "it has {} bytes, the folder's limit is {}", seen.size,
                max_bytes);
  }
  // Without waiting: what became a pipe or a device since it was seen.
  const Descriptor file(::openat(folder_.get(), seen.name.c_str(),
                                 O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (!file) return fail(system_error("it cannot be read", errno));
  struct stat facts {};  // of the file that is read, whatever has its name meanwhile
  const auto is_as_seen = [&] {
    return ::fstat(file.get(), &facts) == 0 && entry_of(seen.name, facts).is_unchanged(seen);
  };
  if (!is_as_seen()) return fail(Errc::Busy, "it has changed");
  if (is_open_for_writing(file.get())) return fail(Errc::Busy, "it is open for writing");
  auto to = open_spool(spool);
  if (!to) return fail(to.error());
  auto copy = copy_bytes(file.get(), *std::move(to), seen.name, max_bytes);
  if (!copy) return copy;
  struct stat named {};
  const bool is_there =
      ::fstatat(folder_.get(), seen.name.c_str(), &named, AT_SYMLINK_NOFOLLOW) == 0 &&
      named.st_dev == facts.st_dev && named.st_ino == facts.st_ino;
  if (!is_as_seen() || !is_there) return fail(Errc::Busy, "it changed while it was read");
  copy->set_owner(account_name(facts.st_uid));
  if (auto mapped = copy->map(); !mapped) return fail(mapped.error());
  return copy;
}

bool FolderFiles::has(const std::string& path) const {
  struct stat facts {};
  const Place place = place_of(path);
  return ::fstatat(place.folder, place.name.c_str(), &facts, AT_SYMLINK_NOFOLLOW) == 0;
}

Result<std::string> FolderFiles::free_target(const std::string& folder,
                                             const std::string& name) const {
  constexpr unsigned kHighest = 100'000;
  for (unsigned number = 1; number <= kHighest; ++number) {
    std::string target = folder + "/" + numbered(name, number);
    if (!has(target)) return target;
  }
  return fail(Errc::LimitExceeded, "{} has too many files of the name {}", folder, name);
}

Result<void> FolderFiles::move(const std::string& name, const std::string& target) const {
  const Place to = place_of(target);
  if (::renameat2(folder_.get(), name.c_str(), to.folder, to.name.c_str(), RENAME_NOREPLACE) == 0)
    return {};
  // Network shares may not know that flag: no one else makes files there.
  const bool is_flag_unknown = errno == EINVAL || errno == ENOSYS;
  if (is_flag_unknown && !has(target) &&
      ::renameat(folder_.get(), name.c_str(), to.folder, to.name.c_str()) == 0) {
    return {};
  }
  return fail(system_error(fmt::format("it cannot be moved to {}", target), errno));
}

Result<void> FolderFiles::write_reason(const std::string& target, const std::string& reason) const {
  const Place place = place_of(target + ".reason.txt");
  const std::string& path = place.name;
  const std::string part = path + ".part";
  {
    const Descriptor file(::openat(place.folder, part.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC,
                                   kReasonMode));
    if (!file) return fail(system_error(path, errno));
    const std::string line = reason + "\n";
    if (!write_all(file.get(), line)) return fail(system_error("a copy cannot be written", errno));
  }
  if (::renameat(place.folder, part.c_str(), place.folder, path.c_str()) == 0) return {};
  return fail(system_error(path, errno));
}

}  // namespace dripline::folders
