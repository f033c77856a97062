#include "protocol/base/private_folder.hpp"

#include <sys/stat.h>
#include <system_error>

namespace dripline {

Result<std::string> make_private_folder(const std::filesystem::path& folder) {
  std::error_code ec;
  const bool is_new = std::filesystem::create_directories(folder, ec);
  if (ec) return fail(Errc::Io, "folder '{}': {}", folder.string(), ec.message());
  struct stat facts {};
  if (::stat(folder.c_str(), &facts) != 0) {
    return fail(Errc::Io, "folder '{}': {}", folder.string(),
                std::generic_category().message(errno));
  }
  const mode_t others = facts.st_mode & (is_new ? S_IRWXO | S_IRWXG : S_IRWXO | S_IWGRP);
  if (others == 0) return std::string();
  constexpr mode_t kModes = 07777;
  if (::chmod(folder.c_str(), facts.st_mode & kModes & ~others) != 0) {
    return fail(Errc::Denied,
                "folder '{}' can be entered or written by others, and it cannot be "
                "closed to them: {}",
                folder.string(), std::generic_category().message(errno));
  }
  if (is_new) return std::string();
  return fmt::format(
      "folder '{}' could be entered or written by others (mode {:o}): closed to them",
      folder.string(), facts.st_mode & kModes);
}

}  // namespace dripline
