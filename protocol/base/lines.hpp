#pragma once

#include <string_view>
#include <vector>

namespace dripline {

/// The lines of a text, each with its end; they share its memory. Joined they are the text. Pure.
std::vector<std::string_view> lines_with_ends(std::string_view text);

/// Without the spaces and tabs at both ends, as values of HTTP's headers are read. Pure.
std::string_view trimmed(std::string_view text);

}  // namespace dripline
