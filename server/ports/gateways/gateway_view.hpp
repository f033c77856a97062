#pragma once

#include "server/machines/machine_control.hpp"
#include "server/ports/port_control.hpp"

namespace dripline::ports {

/// A gateway's line in the form of a port, as the gateway reports it.
PortView view_of(const machines::MachineView& machine, const dds::LineStatus& line);

}  // namespace dripline::ports
