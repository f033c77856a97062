#include "protocol/base/state_location.hpp"

#include <cstdlib>

namespace dripline {

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
