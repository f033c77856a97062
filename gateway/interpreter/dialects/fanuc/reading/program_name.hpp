#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// A program's name in a block, `<NAME>` (keywords.hpp has how it is written).
namespace dripline::interpreter::fanuc {

/// At the head of a block it is the program's own, else that of the program which is called. `at`
/// moves past it. False: an alarm.
bool read_program_name(Run& run, const char*& at);
/// A name beside no M98 or M198 would call nothing. False: an alarm.
bool check_program_name(Run& run);

}  // namespace dripline::interpreter::fanuc
