#pragma once

#include <string>

#include "gateway/interpreter/core/dialect.hpp"
#include "gateway/interpreter/core/geometry/workpiece.hpp"
#include "gateway/machine/motion_backend.hpp"

namespace dripline::gateway {

/// The back ends of `--motion NAME`, separated by commas.
std::string motion_names();
/// Errors: NotFound, naming the back ends that are known.
Result<void> check_motion(std::string_view name);
/// The back end `name` of a machine with this control. Probes meet the workpiece, if it is
/// simulated. Errors: those of check_motion.
Result<machine::MotionFactory> make_motion(std::string_view name,
                                           const interpreter::Dialect& control,
                                           const interpreter::Workpiece& workpiece);

}  // namespace dripline::gateway
