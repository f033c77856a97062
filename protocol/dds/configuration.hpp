#pragma once

#include <string>

#include "protocol/base/result.hpp"
#include "protocol/dds/endpoint.hpp"

namespace dripline::dds {

enum class Role { Server, Gateway };

/// A server is made of this many cells, each with its own port and participant, and every machine
/// belongs to one. In DDS each gateway learns of every endpoint it could ever match at the place it
/// talks to, so with one place for n machines n * n endpoints would be announced (200 machines: 16
/// s of computing time and 800 MB); eight cells make that an eighth. Part of the protocol: both
/// ends must agree.
inline constexpr std::uint32_t kCells = 8;
std::uint32_t cell_of(const std::string& machine);

/// Where a server's cell listens by default (UDP; the next port is its second).
constexpr std::uint16_t server_port(std::uint32_t domain, std::uint32_t cell = 0) {
  return static_cast<std::uint16_t>(7410 + 250 * domain + 2 * cell);
}

/// The Cyclone DDS configuration of one end of the star, complete: nothing is left to defaults that
/// could reach another network. No multicast. Pure.
/// Errors: Syntax, LimitExceeded (an option that cannot be).
Result<std::string> domain_configuration(const NetworkOptions& options, Role role,
                                         std::uint32_t cell);

}  // namespace dripline::dds
