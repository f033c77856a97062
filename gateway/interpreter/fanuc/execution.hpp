#pragma once

#include "gateway/interpreter/fanuc/run.hpp"

namespace dripline::interpreter::fanuc {

/// Executes what was read, in the control's order. False when it pauses; a skip move's answer is
/// taken up by calling it again.
bool execute_block(Run& run);

}  // namespace dripline::interpreter::fanuc
