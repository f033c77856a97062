#pragma once

#include <filesystem>
#include <string>

#include "protocol/base/result.hpp"

namespace dripline {

/// Makes a folder for its owner alone. One that is there already and that others can enter, or its
/// group can write, is closed to them; then the result says so, for the log, and is empty
/// otherwise. Errors: Denied (it is not ours to close), Io.
Result<std::string> make_private_folder(const std::filesystem::path& folder);

}  // namespace dripline
