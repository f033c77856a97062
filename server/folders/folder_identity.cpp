#include "server/folders/folder_identity.hpp"

#include <fcntl.h>
#include <array>
#include <cerrno>
#include <cstring>

namespace dripline::folders {
namespace {

std::string system_words(int error) {
  std::array<char, 128> words{};
  return ::strerror_r(error, words.data(), words.size());
}

FolderIdentity identity_in(const struct stat& facts) {
  return {.device = facts.st_dev, .number = facts.st_ino};
}

bool is_link(int parent, const std::string& name) {
  struct stat facts {};
  return ::fstatat(parent, name.c_str(), &facts, AT_SYMLINK_NOFOLLOW) == 0 &&
         S_ISLNK(facts.st_mode);
}

/// Whether it is `outer` or lies in it.
Result<bool> lies_in(int folder, const FolderIdentity& outer) {
  constexpr int kDeepest = 1000;
  auto at = identity_of(folder);
  Descriptor above;
  for (int depth = 0; at && depth < kDeepest; ++depth) {
    if (*at == outer) return true;
    Descriptor next(::openat(above ? above.get() : folder, "..", O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (!next) return fail(system_error("its parents cannot be looked at", errno));
    const auto parent = identity_of(next.get());
    if (parent && *parent == *at) return false;  // the root
    at = parent;
    above = std::move(next);
  }
  return at ? Result<bool>(fail(Errc::Io, "it has more than {} parents", kDeepest))
            : Result<bool>(fail(at.error()));
}

}  // namespace

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

Result<FolderIdentity> identity_of(int folder) {
  struct stat facts {};
  if (::fstat(folder, &facts) != 0) return fail(system_error("it cannot be looked at", errno));
  return identity_in(facts);
}

Result<Descriptor> open_folder(int parent, const std::string& name) {
  Descriptor folder(
      ::openat(parent, name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  if (folder) return folder;
  const int error = errno;
  if (is_link(parent, name)) return fail(Errc::Denied, "{}: it is a symbolic link", name);
  return fail(system_error(name, error));
}

Result<void> check_same(int parent, const std::string& name, const FolderIdentity& expected) {
  struct stat facts {};
  if (::fstatat(parent, name.c_str(), &facts, AT_SYMLINK_NOFOLLOW) != 0)
    return fail(system_error(name, errno));
  if (identity_in(facts) == expected) return {};
  return fail(Errc::Conflict, "{}: {} there now, not the folder that this server has opened", name,
              S_ISLNK(facts.st_mode)   ? "a symbolic link is"
              : S_ISDIR(facts.st_mode) ? "another folder is"
                                       : "something else is");
}

Result<void> check_apart(int folder, const std::vector<std::filesystem::path>& own) {
  const auto identity = identity_of(folder);
  if (!identity) return fail(identity.error());
  for (const auto& path : own) {
    const Descriptor opened(::open(path.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (!opened && errno == ENOENT) continue;
    if (!opened) return fail(system_error(path.string(), errno));
    const auto outer = identity_of(opened.get());
    if (!outer) return fail(outer.error());
    const auto is_inside = lies_in(folder, *outer);
    if (!is_inside) return fail(is_inside.error());
    const auto is_around = lies_in(opened.get(), *identity);
    if (!is_around) return fail(is_around.error());
    if (!*is_inside && !*is_around) continue;
    return fail(Errc::Denied, "it is, holds or lies in {}, a folder of the server's own",
                path.string());
  }
  return {};
}

}  // namespace dripline::folders
