#include "storage/programs/import_store.hpp"

#include <algorithm>
#include <array>

namespace dripline::storage {
namespace {

constexpr std::array<std::string_view, 4> kImportStates{"pending", "accepted", "accepted_as",
                                                        "rejected"};

}  // namespace

std::string_view to_string(ImportState state) {
  return kImportStates.at(static_cast<std::size_t>(state));
}

Result<ImportState> parse_import_state(std::string_view text) {
  const auto found = std::ranges::find(kImportStates, text);
  if (found == kImportStates.end())
    return fail(Errc::Syntax, "'{}' is no state of an import", text);
  return static_cast<ImportState>(found - kImportStates.begin());
}

}  // namespace dripline::storage
