#pragma once

#include <string>

#include "gateway/interpreter/core/dialect.hpp"
#include "gateway/interpreter/core/geometry/workpiece.hpp"
#include "gateway/interpreter/core/machine_data.hpp"
#include "gateway/machine/motion_backend.hpp"

namespace dripline::gateway {

/// The back ends of `--motion`, separated by commas: "simulated, grbl:ADDRESS".
std::string motion_names();
/// It moves more than numbers: people can be hurt.
bool is_real_motion(std::string_view name);
/// The address of a control at the end of the gateway's own line; empty: the machine is another. It
/// takes text and no motion: SerialGateway drives it.
std::string line_address_of(std::string_view name);
/// Errors: NotFound, naming the back ends that are known; Syntax, LimitExceeded (the address).
Result<void> check_motion(std::string_view name);
/// What the setup file states of the machine and what its probes meet.
struct MotionSetup {
  interpreter::MachineData machine = {};
  interpreter::Workpiece workpiece = {};
};
/// The back end `name` of a machine with this control. A real machine is compared with what is
/// stated of it, a simulated one has these limits, and its probes meet the workpiece. Errors: those
/// of check_motion, Unsupported (a control on a line moves by itself).
Result<machine::MotionFactory> make_motion(std::string_view name,
                                           const interpreter::Dialect& control,
                                           const MotionSetup& setup);

}  // namespace dripline::gateway
