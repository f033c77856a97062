#pragma once

#include "gateway/interpreter/core/program_calls.hpp"
#include "gateway/interpreter/core/setup.hpp"

namespace dripline::interpreter::tnc155 {

/// The programs that a text calls: CALL PGM, % and cycle 12, in both forms. Labels are within a
/// program (core/program_calls.hpp, CallReader).
Result<ProgramCalls> program_calls(const Setup& setup, ProgramSource& source, ProgramIndex program);

/// The same for the later controls.
Result<ProgramCalls> itnc_program_calls(const Setup& setup, ProgramSource& source,
                                        ProgramIndex program);

}  // namespace dripline::interpreter::tnc155
