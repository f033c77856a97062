#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/base/result.hpp"

namespace dripline {

/// Creates a folder for its owner alone. An existing folder that others can enter, or its group can
/// write, is closed to them; the result is then a text for the log, otherwise empty. Errors: Denied
/// (it has another owner), Io.
Result<std::string> make_private_folder(const std::filesystem::path& folder);

/// The interface to the environment, so that tests control it; nullopt for an unset or empty
/// variable.
using Environment = std::function<std::optional<std::string>(std::string_view name)>;
std::optional<std::string> process_environment(std::string_view name);

/// The default state folder of this user's programs; all three must agree, or `dnc` does not find
/// the local server. DRIPLINE_STATE, then /var/lib/dripline for root, then XDG_STATE_HOME/dripline,
/// then ~/.local/state/dripline. Errors: NotFound (none of them is set).
Result<std::string> default_state_folder(const Environment& environment, bool is_root);

}  // namespace dripline
