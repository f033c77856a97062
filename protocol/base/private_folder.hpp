#pragma once

#include <filesystem>
#include <string>

#include "protocol/base/result.hpp"

namespace dripline {

/// Creates a folder for its owner alone. An existing folder that others can enter, or its group can
/// write, is closed to them; the result is then a text for the log, otherwise empty. Errors: Denied
/// (it has another owner), Io.
Result<std::string> make_private_folder(const std::filesystem::path& folder);

}  // namespace dripline
