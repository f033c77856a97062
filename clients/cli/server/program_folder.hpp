#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace dripline::cli {

/// The file in `folder` that holds the program called `name`, with the folder: the first of
/// `interpreter::called_program_names` that can be read.
std::optional<std::string> find_called_program(const std::string& folder, std::string_view name);

/// Its text.
std::optional<std::string> load_called_program(const std::string& folder, std::string_view name);

}  // namespace dripline::cli
