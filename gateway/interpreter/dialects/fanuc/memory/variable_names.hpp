#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// Variables by name, as a 30i has them: [#NAME] of a common variable that SETVN has named,
/// [#_NAME] and [#_NAME[n]] of the system (Series 30i user's manual, custom macro, variables and
/// system variables). Names last to the end of the run here; the control keeps them.
namespace dripline::interpreter::fanuc {

inline constexpr int kFirstNamed = 500;
inline constexpr int kNamedCount = 50;  ///< #500 to #549

/// Whether a variable's name in brackets begins at `at`.
bool is_named_variable(const char* at);
/// `at` is on its bracket, and then past the closing one. False: an alarm that names it.
bool read_variable_name(Run& run, const char*& at, int& number);

/// SETVN n[NAME,NAME]: `at` is past the keyword. `start` is where an alarm points.
bool read_naming(Run& run, const char* start, const char*& at);
/// Puts the names that have been read into force.
bool name_variables(Run& run);

}  // namespace dripline::interpreter::fanuc
