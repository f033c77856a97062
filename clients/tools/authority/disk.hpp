#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "protocol/base/result.hpp"

/// Files and folders that appear as a whole: a process that is killed leaves the old or the new.
/// Errors: Io, naming the path.
namespace dripline::authority {

enum class Secrecy { Open, OwnerAlone };

struct File {
  std::string content;
  Secrecy secrecy = Secrecy::Open;
};
using Files = std::map<std::string, File>;  ///< by name

Result<void> replace_file(const std::filesystem::path& path, const File& file);
/// The folder then holds these files and nothing else; only its owner can enter it. What a killed
/// process left beside it is removed.
Result<void> replace_folder(const std::filesystem::path& folder, const Files& files);
/// Also where it does not exist.
Result<void> remove_folder(const std::filesystem::path& folder);

}  // namespace dripline::authority
