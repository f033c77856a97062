#pragma once

#include <string>
#include <vector>

#include "server/machines/machine_control.hpp"

namespace dripline::machines {

/// Faults between the server and this machine's gateway, in sentences for people; empty when there
/// is none. Without what the machine itself reports.
std::vector<std::string> notices_of(const MachineView& view);

/// Why a machine whose gateway has this protocol version takes no command but a stop; empty when
/// the version is the server's.
std::string protocol_notice(std::uint32_t protocol);

/// "the gateway's clock is 3600.0 s ahead of the server's"; empty while they agree.
std::string clock_notice(std::chrono::microseconds ahead);

}  // namespace dripline::machines
