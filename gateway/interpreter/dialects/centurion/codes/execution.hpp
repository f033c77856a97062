#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

namespace dripline::interpreter::centurion {

/// Executes what was read, in the order of spec 12.3. False when it pauses; a probe move's answer
/// is taken up by calling it again.
bool execute_block(Run& run);

}  // namespace dripline::interpreter::centurion
