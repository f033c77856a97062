#pragma once

#include "gateway/interpreter/dialects/fanuc/reading/keywords.hpp"
#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// Macro statements: assignments, IF, GOTO, WHILE, and the output commands. Reading computes; what
/// was read takes effect when the block is executed.
namespace dripline::interpreter::fanuc {

/// `start` is where the keyword began, `at` is after it.
bool read_statement(Run& run, Keyword keyword, const char* start, const char*& at);
/// `#i = expression`; `at` is on the #.
bool read_assignment_block(Run& run, const char*& at);

bool execute_statement(Run& run);

}  // namespace dripline::interpreter::fanuc
