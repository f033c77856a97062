#pragma once

#include <string_view>
#include <vector>

namespace dripline {

/// The lines of a text, each with its end; they share its memory. Joined they are the text. Pure.
std::vector<std::string_view> lines_with_ends(std::string_view text);

/// Without the `blanks` at both ends; those of the default are what HTTP's headers take for blanks.
/// Pure.
std::string_view trimmed(std::string_view text, std::string_view blanks = " \t");

}  // namespace dripline
