#pragma once

#include <string>
#include <string_view>

#include "protocol/base/result.hpp"
#include "protocol/dds/endpoint.hpp"

namespace dripline::dds {

enum class Role { Server, Gateway };

/// A server consists of this many cells, each with its own port and participant; every machine
/// belongs to one cell. In DDS each gateway learns of all endpoints of its peer that it could
/// match, so one peer for n machines announces n * n endpoints (200 machines: 16 s of computing
/// time and 800 MB); eight cells reduce that to an eighth. Part of the protocol: both ends must
/// agree.
inline constexpr std::uint32_t kCells = 8;
std::uint32_t cell_of(const std::string& machine);

/// The default UDP port of a server's cell; the next port is its second.
constexpr std::uint16_t server_port(std::uint32_t domain, std::uint32_t cell = 0) {
  return static_cast<std::uint16_t>(7410 + 250 * domain + 2 * cell);
}

/// The Cyclone DDS configuration of one end of the star, complete: no default may
/// reach another network. No multicast. Pure.
/// Errors: Syntax, LimitExceeded (an impossible option).
Result<std::string> domain_configuration(const NetworkOptions& options, Role role,
                                         std::uint32_t cell);

/// Sends the log of Cyclone DDS to `to` instead of standard error, for the whole process. `to` is
/// called on any thread and must bound its output: each packet of a stranger can cause a line.
void send_log_to(void (*to)(bool is_error, std::string_view text));

}  // namespace dripline::dds
