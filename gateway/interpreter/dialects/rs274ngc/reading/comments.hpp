#pragma once

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// Comments that do something (NIST 3.3; LinuxCNC: active comments). What they name is never
/// opened: it goes out as events.
namespace dripline::interpreter::rs274ngc {

/// Whether a comment shows a message to the operator.
bool is_message(const char* begin, const char* end);

/// Does what the line's last comment asks for.
bool execute_comment(Run& run);

}  // namespace dripline::interpreter::rs274ngc
