#pragma once

#include <string>
#include <string_view>

#include "protocol/base/result.hpp"
#include "protocol/dds/endpoint.hpp"

namespace dripline::dds {

enum class Role { Server, Gateway };

/// The cell of a machine where there are so many (NetworkOptions::cells). Part of the protocol.
std::uint32_t cell_of(const std::string& machine, std::uint32_t cells = kFewestCells);
/// Whether a server with so many cells takes this machine in cell `cell`: its gateway may know of
/// fewer cells than the server has.
bool takes_machine(const std::string& machine, std::uint32_t cell, std::uint32_t cells);

/// The default UDP port of a server's cell; the next port is its second.
constexpr std::uint16_t server_port(std::uint32_t domain, std::uint32_t cell = 0) {
  return static_cast<std::uint16_t>(7410 + 250 * domain + 2 * cell);
}

/// The first of the two ports of a server's cell, as it is opened with these options.
constexpr std::uint16_t first_port(const NetworkOptions& options, std::uint32_t cell) {
  return options.port != 0 ? static_cast<std::uint16_t>(options.port + 2 * cell)
                           : server_port(options.domain, cell);
}

/// Whether a server that is opened now finds its UDP ports free. Errors: Busy (it names one that is
/// not; another server on this computer?).
Result<void> check_ports(const NetworkOptions& options);
/// The same of the second port of each cell alone: a GatewayListener has the first ones.
Result<void> check_second_ports(const NetworkOptions& options);

/// The Cyclone DDS configuration of one end of the star, complete: no default may
/// reach another network. No multicast. Pure.
/// Errors: Syntax, LimitExceeded (an impossible option).
Result<std::string> domain_configuration(const NetworkOptions& options, Role role,
                                         std::uint32_t cell);

/// Sends the log of Cyclone DDS to `to` instead of standard error, for the whole process. `to` is
/// called on any thread and must bound its output: each packet of a stranger can cause a line.
void send_log_to(void (*to)(bool is_error, std::string_view text));

}  // namespace dripline::dds
