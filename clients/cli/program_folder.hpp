#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dripline::cli {

/// File names that a called program may have, best first. `name` is as the control says it
/// ("O0002", "2", "SLOT"). For a number: O2.nc, O0002.nc, 2.nc, 2.h, 2.i; otherwise, and after
/// those, the name itself and with .nc. None for names that would leave the folder.
std::vector<std::string> called_program_names(std::string_view name);

/// The first of these that is a file in `folder` and can be read, with the folder.
std::optional<std::string> find_called_program(const std::string& folder, std::string_view name);

/// Its text.
std::optional<std::string> load_called_program(const std::string& folder, std::string_view name);

}  // namespace dripline::cli
