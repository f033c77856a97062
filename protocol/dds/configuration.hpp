#pragma once

#include <string>

#include "protocol/base/result.hpp"
#include "protocol/dds/endpoint.hpp"

namespace dripline::dds {

enum class Role { Server, Gateway };

/// Where a server of this domain listens (UDP).
constexpr std::uint16_t server_port(std::uint32_t domain) {
  return static_cast<std::uint16_t>(7410 + 250 * domain);
}

/// The Cyclone DDS configuration of one end of the star, complete: nothing is left to defaults that
/// could reach another network. No multicast. Pure.
/// Errors: Syntax, LimitExceeded (an option that can not be).
Result<std::string> domain_configuration(const NetworkOptions& options, Role role);

}  // namespace dripline::dds
