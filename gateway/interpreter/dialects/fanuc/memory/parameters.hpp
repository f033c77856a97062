#pragma once

#include <optional>

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// G10 L50 to G11: a program writes parameters of the control. Those that this interpreter goes by
/// take effect, until the end of the run; any other is an alarm.
namespace dripline::interpreter::fanuc {

/// What PRM names: a parameter, or one bit of it.
struct ParameterName {
  double number = 0;
  std::optional<double> bit;
  bool has_axis = false;  ///< of an axis, a spindle or a path
};
/// PRM of a 30i (user's manual, custom macro, arithmetic and logic operation): the parameters that
/// this interpreter goes by. Any other is an alarm that names it.
bool read_parameter(Run& run, const ParameterName& name, std::uint32_t column, double& value);

/// G10 L50, and L52 as later controls have it.
bool begin_parameters(Run& run);
/// A block between: N is the parameter's number, R its value.
bool enter_parameter(Run& run);

}  // namespace dripline::interpreter::fanuc
