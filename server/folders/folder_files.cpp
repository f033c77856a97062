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
#include <memory>

#include "protocol/base/durable_file.hpp"

namespace dripline::folders {
namespace {

constexpr std::size_t kPiece = 256 * 1024;
/// Who may read or write the hot folder may do so in its two folders; others write there never.
constexpr mode_t kFolderModes = 0775, kReasonModes = 0664;

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

struct CopySource {
  int file = -1;
  const std::string& name;
  std::uint64_t max_bytes = 0;
};

Result<FileCopy> copy_bytes(const CopySource& from, Descriptor to, AnswerWatch& answers) {
  std::vector<char> piece(kPiece);
  Sha256 digest;
  std::uint64_t size = 0;
  for (;;) {
    const auto got = ::read(from.file, piece.data(), piece.size());
    answers.answered();
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return fail(system_error(from.name, errno));
    if (got == 0) return FileCopy(std::move(to), size, digest.digest());
    const auto bytes = static_cast<std::size_t>(got);
    size += bytes;
    if (size > from.max_bytes) {
      return fail(Errc::LimitExceeded, "it has more than {} bytes, the folder's limit",
                  from.max_bytes);
    }
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

/// What was made has the group and the permissions of the folder that it was made in, whatever the
/// process's umask is: the people of that folder read there what became of their files. Best
/// effort: some shares know neither, and the group may be one that the server is not of.
void open_to_people(int made, int folder, mode_t modes) {
  struct stat facts {};
  if (::fstat(folder, &facts) != 0) return;
  (void)!::fchown(made, static_cast<uid_t>(-1), facts.st_gid);
  const mode_t mode = (facts.st_mode & modes) | (modes & S_IRWXU);
  // The bit that hands the group on: a hardened service may not set it.
  const mode_t handed_on = (modes & S_IXUSR) != 0 ? facts.st_mode & S_ISGID : 0;
  if (handed_on != 0 && ::fchmod(made, mode | handed_on) == 0) return;
  (void)!::fchmod(made, mode);
}

/// A new file of this name and no one else's: neither a pipe that no one reads, nor a link, nor a
/// file that was there. Errors: those of system_error.
Result<Descriptor> make_file(int folder, const std::string& name) {
  constexpr int kNew = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;
  Descriptor file(::openat(folder, name.c_str(), kNew, S_IRUSR | S_IWUSR));
  if (!file && errno == EEXIST) {  // of a server that was killed
    (void)::unlinkat(folder, name.c_str(), 0);
    file = Descriptor(::openat(folder, name.c_str(), kNew, S_IRUSR | S_IWUSR));
  }
  if (!file) return fail(system_error(name, errno));
  struct stat facts {};
  if (::fstat(file.get(), &facts) != 0) return fail(system_error(name, errno));
  if (!S_ISREG(facts.st_mode)) return fail(Errc::Denied, "{}: it is no file", name);
  return file;
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

FolderFiles::FolderFiles(const Options& options, Descriptor folder)
    : path_(options.settings.path),
      own_folders_(options.own_folders),
      answers_(&options.answers),
      folder_(std::move(folder)),
      done_{.name = options.settings.done},
      failed_{.name = options.settings.failed} {}

Result<FolderFiles> FolderFiles::open(const Options& options) {
  const AnswerWatch::Wait wait(options.answers);
  auto folder = open_folder(AT_FDCWD, options.settings.path.string());
  if (!folder) return fail(folder.error());
  FolderFiles files(options, *std::move(folder));
  const auto identity = identity_of(files.folder_.get());
  if (!identity) return fail(identity.error());
  files.identity_ = *identity;
  if (auto apart = check_apart(files.folder_.get(), files.own_folders_); !apart)
    return fail(apart.error().code, "{}: {}", files.path_.string(), apart.error().what);
  for (Subfolder* sub : {&files.done_, &files.failed_}) {
    if (auto opened = files.open_subfolder(*sub); !opened) return fail(opened.error());
  }
  return files;
}

/// Made where it is missing; never the target of a symbolic link.
Result<void> FolderFiles::open_subfolder(Subfolder& sub) {
  const bool is_made = ::mkdirat(folder_.get(), sub.name.c_str(), S_IRWXU) == 0;
  if (!is_made && errno != EEXIST) return fail(system_error((path_ / sub.name).string(), errno));
  auto folder = open_folder(folder_.get(), sub.name);
  if (!folder) return fail(folder.error().code, "{}/{}", path_.string(), folder.error().what);
  const auto identity = identity_of(folder->get());
  if (!identity) return fail(identity.error());
  if (auto apart = check_apart(folder->get(), own_folders_); !apart)
    return fail(apart.error().code, "{}/{}: {}", path_.string(), sub.name, apart.error().what);
  if (is_made) open_to_people(folder->get(), folder_.get(), kFolderModes);
  sub.folder = *std::move(folder);
  sub.identity = *identity;
  return {};
}

Result<void> FolderFiles::check_subfolder(Subfolder& sub) {
  const auto same = check_same(folder_.get(), sub.name, sub.identity);
  if (same) return {};
  if (same.error().code == Errc::NotFound) return open_subfolder(sub);
  return fail(same.error().code, "{}/{}", path_.string(), same.error().what);
}

Result<void> FolderFiles::check() {
  const AnswerWatch::Wait wait(*answers_);
  if (auto same = check_same(AT_FDCWD, path_.string(), identity_); !same) return same;
  for (Subfolder* sub : {&done_, &failed_}) {
    if (auto same = check_subfolder(*sub); !same) return same;
  }
  return {};
}

std::filesystem::path FolderFiles::descriptor_path() const {
  return fmt::format("/proc/self/fd/{}", folder_.get());
}

FolderFiles::Place FolderFiles::place_of(const std::string& target) const {
  const auto slash = target.find('/');
  if (slash == std::string::npos) return {folder_.get(), target};
  const bool is_done = target.substr(0, slash) == done_.name;
  return {(is_done ? done_ : failed_).folder.get(), target.substr(slash + 1)};
}

Result<std::vector<Entry>> FolderFiles::list() const {
  const AnswerWatch::Wait wait(*answers_);
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
    answers_->answered();
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
  const AnswerWatch::Wait wait(*answers_);
  // Without waiting: what became a pipe or a device since it was seen.
  const Descriptor file(::openat(folder_.get(), seen.name.c_str(),
                                 O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (!file) return fail(system_error("it cannot be read", errno));
  struct stat facts {};  // of the file that is read, whatever has its name meanwhile
  const auto is_as_seen = [&] {
    return ::fstat(file.get(), &facts) == 0 && entry_of(seen.name, facts).is_unchanged(seen);
  };
  if (!is_as_seen()) return fail(Errc::Busy, "it has changed");
  if (facts.st_nlink > 1)
    return fail(Errc::Denied, "it is a hard link: the same file has another name too");
  if (is_open_for_writing(file.get())) return fail(Errc::Busy, "it is open for writing");
  auto to = open_spool(spool);
  if (!to) return fail(to.error());
  auto copy = copy_bytes({.file = file.get(), .name = seen.name, .max_bytes = max_bytes},
                         *std::move(to), *answers_);
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
  const AnswerWatch::Wait wait(*answers_);
  return is_there(path);
}

bool FolderFiles::is_there(const std::string& path) const {
  struct stat facts {};
  const Place place = place_of(path);
  return ::fstatat(place.folder, place.name.c_str(), &facts, AT_SYMLINK_NOFOLLOW) == 0;
}

Result<std::string> FolderFiles::free_target(const std::string& folder,
                                             const std::string& name) const {
  const AnswerWatch::Wait wait(*answers_);
  constexpr unsigned kHighest = 100'000;
  for (unsigned number = 1; number <= kHighest; ++number) {
    std::string target = folder + "/" + numbered(name, number);
    if (!is_there(target)) return target;
    answers_->answered();
  }
  return fail(Errc::LimitExceeded, "{} has too many files of the name {}", folder, name);
}

Result<void> FolderFiles::move(const std::string& name, const std::string& target) const {
  const AnswerWatch::Wait wait(*answers_);
  const Place to = place_of(target);
  if (::renameat2(folder_.get(), name.c_str(), to.folder, to.name.c_str(), RENAME_NOREPLACE) == 0)
    return {};
  // Network shares may not know that flag: no one else makes files there.
  const bool is_flag_unknown = errno == EINVAL || errno == ENOSYS;
  if (is_flag_unknown && !is_there(target) &&
      ::renameat(folder_.get(), name.c_str(), to.folder, to.name.c_str()) == 0) {
    return {};
  }
  return fail(system_error(fmt::format("it cannot be moved to {}", target), errno));
}

Result<void> FolderFiles::write_reason(const std::string& target, const std::string& reason) const {
  const AnswerWatch::Wait wait(*answers_);
  const Place place = place_of(target + ".reason.txt");
  const std::string& path = place.name;
  const std::string part = path + ".part";
  {
    const auto file = make_file(place.folder, part);
    if (!file) return fail(file.error());
    const std::string line = reason + "\n";
    if (!write_all(file->get(), line))
      return fail(system_error("a reason cannot be written", errno));
    open_to_people(file->get(), place.folder, kReasonModes);
  }
  if (::renameat(place.folder, part.c_str(), place.folder, path.c_str()) == 0) return {};
  return fail(system_error(path, errno));
}

}  // namespace dripline::folders
