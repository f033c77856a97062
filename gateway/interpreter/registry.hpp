#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/dialect.hpp"
#include "gateway/interpreter/core/program_calls.hpp"

namespace dripline::interpreter {

std::span<const Dialect> dialects();
/// Errors: NotFound, naming the known ones.
Result<const Dialect*> find_dialect(std::string_view name);
/// What reads the calls in texts of this control; nullptr: it calls no other programs.
CallReader call_reader(std::string_view name);
/// The candidates, likeliest first; one entry when the text leaves no doubt, none when nothing
/// fits.
std::vector<const Dialect*> detect_dialect(std::string_view head, std::string_view file_name);

}  // namespace dripline::interpreter
