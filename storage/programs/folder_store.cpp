#include "storage/programs/folder_store.hpp"

#include <algorithm>
#include <array>

namespace dripline::storage {
namespace {

constexpr std::array<std::string_view, 3> kFileStates{"taken", "stored", "failed"};

}  // namespace

std::string_view to_string(FolderFileState state) {
  return kFileStates.at(static_cast<std::size_t>(state));
}

Result<FolderFileState> parse_folder_file_state(std::string_view text) {
  const auto found = std::ranges::find(kFileStates, text);
  if (found == kFileStates.end())
    return fail(Errc::Syntax, "'{}' is no state of a folder's file", text);
  return static_cast<FolderFileState>(found - kFileStates.begin());
}

}  // namespace dripline::storage
