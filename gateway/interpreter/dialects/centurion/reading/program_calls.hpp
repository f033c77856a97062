#pragma once

#include "gateway/interpreter/core/program_calls.hpp"
#include "gateway/interpreter/core/setup.hpp"

namespace dripline::interpreter::centurion {

/// The programs that a text calls: M98 and G65 with P, CALL, and the G and M codes that the setup's
/// parameters bind to programs (core/program_calls.hpp, CallReader).
Result<ProgramCalls> program_calls(const Setup& setup, ProgramSource& source, ProgramIndex program);

}  // namespace dripline::interpreter::centurion
