#pragma once

#include "gateway/interpreter/core/program_calls.hpp"
#include "gateway/interpreter/core/setup.hpp"

namespace dripline::interpreter::rs274ngc {

/// The files that a text calls: O-words with `call`, and M98 with P (core/program_calls.hpp,
/// CallReader).
Result<ProgramCalls> program_calls(const Setup& setup, ProgramSource& source, ProgramIndex program);

}  // namespace dripline::interpreter::rs274ngc
