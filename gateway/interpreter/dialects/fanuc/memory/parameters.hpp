#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// G10 L50 to G11: a program writes parameters of the control. Those that this interpreter goes by
/// take effect, until the end of the run; any other is an alarm.
namespace dripline::interpreter::fanuc {

/// G10 L50, and L52 as later controls have it.
bool begin_parameters(Run& run);
/// A block between: N is the parameter's number, R its value.
bool enter_parameter(Run& run);

}  // namespace dripline::interpreter::fanuc
