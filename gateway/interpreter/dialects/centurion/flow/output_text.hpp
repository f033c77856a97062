#pragma once

#include <string>

#include "gateway/interpreter/dialects/centurion/run.hpp"

/// The text of PRINT and DPRNT (manual: text rules of PRINT and DPRNT) and the device it goes to.
namespace dripline::interpreter::centurion {

/// The number as #n[LT] prints it: `leading` digits padded with zeros (0 = as many as needed, at
/// least one), `decimals` digits after the point, halves away from zero. Appends to `text`.
void append_number(std::string& text, double value, int leading, int decimals);

/// The items, after their keyword. Each moves `at` after itself.
bool print_to_screen(Run& run, const char*& at);
bool print_to_device(Run& run, const char*& at);
bool open_device(Run& run, const char*& at);
/// PCLOS, and the end of the program; nothing when nothing is open.
void close_open_device(Run& run);

}  // namespace dripline::interpreter::centurion
