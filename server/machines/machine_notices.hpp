#pragma once

#include <string>
#include <vector>

#include "server/machines/machine_control.hpp"

namespace dripline::machines {

/// What is wrong between the server and this machine's gateway, in sentences for people; empty when
/// all is well. Nothing of what the machine itself reports.
std::vector<std::string> notices_of(const MachineView& view);

/// Why nothing but a stop can be ordered of a machine whose gateway speaks this protocol; empty
/// when it speaks ours.
std::string protocol_notice(std::uint32_t protocol);

/// "the gateway's clock is 3600.0 s ahead of the server's"; empty while they agree.
std::string clock_notice(std::chrono::microseconds ahead);

}  // namespace dripline::machines
