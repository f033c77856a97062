#include "clients/tools/authority/disk.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "protocol/base/descriptor.hpp"
#include "protocol/base/durable_file.hpp"

namespace dripline::authority {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> not_written(const fs::path& path) {
  return fail(Errc::Io, "'{}' cannot be written: {}", path.string(),
              std::generic_category().message(errno));
}

/// Beside the thing itself, so that it can be renamed.
fs::path draft_of(const fs::path& path) {
  return path.parent_path() / (".new-" + path.filename().string());
}

Result<void> synced(const fs::path& folder) {
  if (!sync_folder(folder)) return not_written(folder);
  return {};
}

Result<void> write_new(const fs::path& path, const File& file) {
  constexpr mode_t kOwner = S_IRUSR | S_IWUSR;
  const mode_t mode = file.secrecy == Secrecy::OwnerAlone ? kOwner : kOwner | S_IRGRP | S_IROTH;
  const Descriptor out(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
  if (!out) return not_written(path);
  if (!write_all(out.get(), file.content)) return not_written(path);
  if (::fsync(out.get()) != 0) return not_written(path);
  return {};
}

/// The draft takes the folder's place; what was there is in the draft's then.
Result<void> exchange(const fs::path& draft, const fs::path& folder) {
  if (::renameat2(AT_FDCWD, draft.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) == 0)
    return {};
  if (errno == ENOENT && ::rename(draft.c_str(), folder.c_str()) == 0) return {};
  if (errno != EINVAL) return not_written(folder);
  // A file system that cannot exchange: between the two renames there is no folder.
  const fs::path old = draft.string() + ".old";
  std::error_code ec;
  fs::remove_all(old, ec);
  if (::rename(folder.c_str(), old.c_str()) != 0 && errno != ENOENT) return not_written(folder);
  if (::rename(draft.c_str(), folder.c_str()) != 0) return not_written(folder);
  fs::remove_all(old, ec);
  return {};
}

}  // namespace

Result<void> remove_folder(const fs::path& folder) {
  std::error_code ec;
  fs::remove_all(folder, ec);
  if (ec) return fail(Errc::Io, "'{}' cannot be removed: {}", folder.string(), ec.message());
  return {};
}

Result<void> replace_file(const fs::path& path, const File& file) {
  const fs::path draft = draft_of(path);
  ::unlink(draft.c_str());
  if (auto written = write_new(draft, file); !written) return written;
  if (::rename(draft.c_str(), path.c_str()) != 0) return not_written(path);
  return synced(path.parent_path());
}

Result<void> replace_folder(const fs::path& folder, const Files& files) {
  const fs::path draft = draft_of(folder);
  if (auto removed = remove_folder(draft); !removed) return removed;
  if (::mkdir(draft.c_str(), S_IRWXU) != 0) return not_written(draft);
  for (const auto& [name, file] : files) {
    if (auto written = write_new(draft / name, file); !written) return written;
  }
  if (auto done = synced(draft); !done) return done;
  if (auto exchanged = exchange(draft, folder); !exchanged) return exchanged;
  if (auto done = synced(folder.parent_path()); !done) return done;
  return remove_folder(draft);
}

}  // namespace dripline::authority
