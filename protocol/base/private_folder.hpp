#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/base/result.hpp"

namespace dripline {

/// Paths within a folder, of which one at least is in each of its kind that was used before.
using FolderMarks = std::initializer_list<const char*>;

/// Creates a folder for its owner alone. An existing folder that others can enter, or its group can
/// write, is closed to them; the result is then a text for the log, otherwise empty. A folder that
/// may be in use for something else is not closed, and stays as it is: one with content and none
/// of the marks, of another owner, with the sticky bit, or at the top of the file system. Errors:
/// Denied (that, or it cannot be closed), Io.
Result<std::string> make_private_folder(const std::filesystem::path& folder, FolderMarks marks);
/// The same of a folder that is ours by its place or name, whatever is in it.
Result<std::string> make_private_subfolder(const std::filesystem::path& folder);

/// The interface to the environment, so that tests control it; nullopt for an unset or empty
/// variable.
using Environment = std::function<std::optional<std::string>(std::string_view name)>;
std::optional<std::string> process_environment(std::string_view name);

/// The default state folder of this user's programs; all three must agree, or `dnc` does not find
/// the local server. DRIPLINE_STATE, then /var/lib/dripline for root, then XDG_STATE_HOME/dripline,
/// then ~/.local/state/dripline. Errors: NotFound (none of them is set).
Result<std::string> default_state_folder(const Environment& environment, bool is_root);

}  // namespace dripline
