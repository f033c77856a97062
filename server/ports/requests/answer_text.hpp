#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "storage/store.hpp"

/// Answers to a control in the only form it can show: programs of comments.
namespace dripline::ports {

inline constexpr std::size_t kMaxListed = 200;

/// Capitals, digits and `.-+/=:,` only, at most 60 characters: what every control takes in a
/// comment.
std::string comment_text(std::string_view words);
/// `words` broken at blanks into at most four lines of that length; none for no words.
std::vector<std::string> comment_lines(std::string_view words);
/// A program called `name` ("O9998") that shows these lines and does nothing.
std::string comment_program(const std::string& name, std::span<const std::string> lines);
/// One line for each program that can be sent to a machine with that control (empty: any), at most
/// kMaxListed, and a last line with the number of the rest.
std::vector<std::string> listing(std::span<const storage::ProgramSummary> programs,
                                 const std::string& control);

/// Those of them that a protocol with numbered programs can name and that are known to be for
/// `control`, in order of their numbers.
std::vector<storage::Revision> numbered_programs(std::span<const storage::ProgramSummary> programs,
                                                 const std::string& control);

}  // namespace dripline::ports
