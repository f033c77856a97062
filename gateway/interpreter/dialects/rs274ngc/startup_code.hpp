#pragma once

#include "gateway/interpreter/dialects/rs274ngc/options.hpp"

namespace dripline::interpreter::rs274ngc {

/// The modes that every program begins with after LinuxCNC's RS274NGC_STARTUP_CODE, over those of
/// power on in `state`: units, plane, G7, the path mode, G90.1, G98 and S. LinuxCNC executes the
/// code once, at power on: what M2 ends is in force in the first program only, and is refused. Two
/// of these are not: the plane, which is the builder's wish (G18 of a lathe), and F, which is left
/// out, because a program without one is an alarm.
/// Errors: Syntax (an alarm of the line), Unsupported (it does more than set these modes).
Result<void> apply_startup_code(const ControlOptions& options, State& state);

}  // namespace dripline::interpreter::rs274ngc
