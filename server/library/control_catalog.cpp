#include "server/library/control_catalog.hpp"

#include <fmt/ranges.h>
#include <algorithm>

namespace dripline::library {

Result<void> check_control(const ControlCatalog& catalog, std::string_view control) {
  const std::vector<std::string> names = catalog.names();
  if (std::ranges::find(names, control) != names.end()) return {};
  return fail(Errc::Unsupported, "control '{}' is not known; known are: {}", control,
              fmt::join(names, ", "));
}

Result<std::string> detect_control(const ControlCatalog& catalog, std::string_view head,
                                   std::string_view program) {
  std::vector<std::string> candidates = catalog.detect(head, program);
  if (candidates.size() == 1) return std::move(candidates.front());
  if (candidates.empty()) {
    return fail(Errc::Unsupported,
                "program '{}' does not show which control it is for; name it, one of: {}", program,
                fmt::join(catalog.names(), ", "));
  }
  return fail(Errc::Unsupported, "program '{}' could be for several controls; name one of: {}",
              program, fmt::join(candidates, ", "));
}

}  // namespace dripline::library
