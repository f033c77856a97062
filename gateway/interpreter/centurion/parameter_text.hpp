#pragma once

#include <string>
#include <string_view>

#include "gateway/interpreter/setup.hpp"

/// The parameters as text that goes over a serial line: a program that sets them with G10, so that
/// a control takes it like any other (spec 7.6, 20.3). Numbers are those of parameters.hpp.
namespace dripline::interpreter::centurion {

/// Offsets, tools, axis and power parameters of a setup, all of them; P0-P199 that are not 0.
/// Errors: those of load_memory.
Result<std::string> write_parameter_text(const Setup& setup);

/// The text of a setup file from such a program. Errors: Syntax, naming the line (anything besides
/// comments, an O number, G10, G11, G20, G21, M30 and P... = number; a number that has no name in a
/// setup).
Result<std::string> setup_of_parameter_text(std::string_view text);

}  // namespace dripline::interpreter::centurion
