#pragma once

#include "gateway/interpreter/dialects/centurion/reading/keywords.hpp"
#include "gateway/interpreter/dialects/centurion/run.hpp"

namespace dripline::interpreter::centurion {

/// The statement that begins with `keyword`; `at` is after the keyword and moves after the
/// statement, for a false condition to the end of the block. The keyword begins at `start`.
bool read_statement(Run& run, Keyword keyword, const char* start, const char*& at);

/// The rest of TANL, TANA or CGEN (geometry_statements.cpp): from the parameters P90-P97 to P80-P85
/// and P97.
bool solve_geometry(Run& run, Keyword keyword, const char* start, const char*& at);

/// `P n = expression` and `PB n = expression`; `at` is after the =.
bool assign_parameter(Run& run, double number, const char* start, const char*& at);
bool assign_byte(Run& run, double number, const char* start, const char*& at);
bool store_parameter(Run& run, int number, double value, std::uint32_t column);
bool store_byte(Run& run, int number, double value, std::uint32_t column);

/// Whether `text` can answer INPUT: a number, or nothing.
bool is_input_answer(std::string_view text);

}  // namespace dripline::interpreter::centurion
