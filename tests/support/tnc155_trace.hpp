#pragma once

#include <string>
#include <string_view>

namespace dripline::interpreter {

/// What a TNC 155 program does, without the places in its text: two forms of a program that do the
/// same have equal ones. Of an alarm only its id. Programs 8 and 9 can be called. Ends with "..."
/// after many blocks.
std::string tnc155_trace(std::string_view text);

}  // namespace dripline::interpreter
