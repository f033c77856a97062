#include "protocol/base/private_folder.hpp"

#include <cstdlib>
#include <system_error>

#include <sys/stat.h>

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
