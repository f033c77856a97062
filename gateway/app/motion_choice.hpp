#pragma once

#include <string>

#include "gateway/interpreter/core/dialect.hpp"
#include "gateway/interpreter/core/geometry/workpiece.hpp"
#include "gateway/machine/motion_backend.hpp"

namespace dripline::gateway {

/// The back ends of `--motion`, separated by commas: "simulated, grbl:ADDRESS".
std::string motion_names();
/// It moves more than numbers: somebody can be hurt.
bool is_real_motion(std::string_view name);
/// Errors: NotFound, naming the back ends that are known; Syntax, LimitExceeded (the address).
Result<void> check_motion(std::string_view name);
/// The back end `name` of a machine with this control. Probes meet the workpiece, if it is
/// simulated. Errors: those of check_motion.
Result<machine::MotionFactory> make_motion(std::string_view name,
                                           const interpreter::Dialect& control,
                                           const interpreter::Workpiece& workpiece);

}  // namespace dripline::gateway
