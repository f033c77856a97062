#include "storage/folder_store.hpp"

#include <algorithm>
#include <array>

namespace dripline::storage {
namespace {

constexpr std::array<std::string_view, 3> kStates{"taken", "stored", "failed"};

}  // namespace

std::string_view to_string(FolderFileState state) {
  return kStates.at(static_cast<std::size_t>(state));
}

Result<FolderFileState> parse_folder_file_state(std::string_view text) {
  const auto found = std::ranges::find(kStates, text);
  if (found == kStates.end())
    return fail(Errc::Syntax, "'{}' is no state of a folder's file", text);
  return static_cast<FolderFileState>(found - kStates.begin());
}

}  // namespace dripline::storage
