#pragma once

#include "gateway/interpreter/core/program_calls.hpp"
#include "gateway/interpreter/core/setup.hpp"

namespace dripline::interpreter::fanuc {

/// The programs that a text calls: M98 and M198, G65 and G66, and the G, M and T codes that the
/// setup's parameters bind to programs (core/program_calls.hpp, CallReader).
Result<ProgramCalls> program_calls(const Setup& setup, ProgramSource& source, ProgramIndex program);
/// With the options of a lathe.
Result<ProgramCalls> lathe_program_calls(const Setup& setup, ProgramSource& source,
                                         ProgramIndex program);

}  // namespace dripline::interpreter::fanuc
