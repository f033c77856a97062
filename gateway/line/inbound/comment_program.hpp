#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dripline::line {

/// `words` broken at blanks into at most four lines that fit a comment; none for no words.
std::vector<std::string> comment_lines(std::string_view words);
/// A program called `name` ("O9998") that shows these lines and does nothing: capitals, digits and
/// `.-+/=:,` only, which every control takes in a comment.
std::string comment_program(const std::string& name, std::span<const std::string> lines);

}  // namespace dripline::line
