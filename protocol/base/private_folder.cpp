#include "protocol/base/private_folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "protocol/base/descriptor.hpp"

namespace dripline {

namespace {

namespace fs = std::filesystem;

constexpr mode_t kModes = 07777;

tl::unexpected<Error> folder_failed(const fs::path& folder) {
  return fail(Errc::Io, "folder '{}': {}", folder.string(), std::generic_category().message(errno));
}

/// What others may do with a folder that they are not to do.
mode_t rights_of_others(mode_t mode) {
  return mode & (S_IRWXO | S_IWGRP);
}

/// Why closing the folder may take it from someone else; empty: it does not.
std::string foreign_use(const fs::path& folder, const struct stat& facts, FolderMarks marks) {
  std::error_code ec;
  const fs::path whole = fs::canonical(folder, ec);
  if (ec) return ec.message();
  if (facts.st_uid != ::geteuid()) return fmt::format("its owner is uid {}", facts.st_uid);
  if (whole == whole.root_path() || whole.parent_path() == whole.root_path())
    return "it is at the top of the file system";
  if ((facts.st_mode & S_ISVTX) != 0) return "it is shared (sticky bit)";
  const fs::directory_iterator content(whole, ec);
  if (ec) return ec.message();
  if (content == fs::directory_iterator()) return {};
  const auto is_there = [&](const char* mark) { return fs::exists(whole / mark, ec); };
  if (std::any_of(marks.begin(), marks.end(), is_there)) return {};
  return fmt::format("'{}' in it is not of Dripline", content->path().filename().string());
}

/// Closes the folder itself, not what its name has become meanwhile.
Result<std::string> close_folder(const fs::path& folder, const Descriptor& opened,
                                 const struct stat& facts) {
  const mode_t mode = facts.st_mode & kModes;
  if (::fchmod(opened.get(), mode & ~rights_of_others(mode)) != 0) {
    return fail(Errc::Denied,
                "folder '{}' can be entered or written by others, and it cannot be "
                "closed to them: {}",
                folder.string(), std::generic_category().message(errno));
  }
  return fmt::format(
      "folder '{}' could be entered or written by others (mode {:o}): closed to "
      "them",
      folder.string(), mode);
}

/// `marks`: nullopt where any content is ours.
Result<std::string> make_private(const fs::path& folder, std::optional<FolderMarks> marks) {
  std::error_code ec;
  const bool is_new = fs::create_directories(folder, ec);
  if (ec) return fail(Errc::Io, "folder '{}': {}", folder.string(), ec.message());
  const Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  struct stat facts {};
  if (!opened || ::fstat(opened.get(), &facts) != 0) return folder_failed(folder);
  if (is_new) {
    const bool is_open = (facts.st_mode & (S_IRWXG | S_IRWXO)) != 0;
    if (is_open && ::fchmod(opened.get(), S_IRWXU) != 0) return folder_failed(folder);
    return std::string();
  }
  if (rights_of_others(facts.st_mode) == 0) return std::string();
  const std::string use = marks ? foreign_use(folder, facts, *marks) : std::string();
  if (use.empty()) return close_folder(folder, opened, facts);
  return fail(Errc::Denied,
              "folder '{}' can be entered or written by others (mode {:o}), and is left so, as it "
              "may be in use for something else: {}. Name another folder, or, if it is to be "
              "this one, close it to others (chmod 750)",
              folder.string(), facts.st_mode & kModes, use);
}

}  // namespace

Result<std::string> make_private_folder(const fs::path& folder, FolderMarks marks) {
  return make_private(folder, marks);
}

Result<std::string> make_private_subfolder(const fs::path& folder) {
  return make_private(folder, std::nullopt);
}

std::optional<std::string> process_environment(std::string_view name) {
  const char* value = std::getenv(std::string(name).c_str());
  if (value == nullptr || *value == '\0') return std::nullopt;
  return std::string(value);
}

Result<std::string> default_state_folder(const Environment& environment, bool is_root) {
  if (auto state = environment("DRIPLINE_STATE")) return *state;
  if (is_root) return std::string("/var/lib/dripline");
  if (auto state = environment("XDG_STATE_HOME")) return *state + "/dripline";
  if (auto home = environment("HOME")) return *home + "/.local/state/dripline";
  return fail(Errc::NotFound, "no state folder: HOME is not set, expected --state DIR");
}

}  // namespace dripline
