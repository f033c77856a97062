#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "server/identity/permission.hpp"

namespace dripline::api {

/// Where a request names the machine that it acts on, which must be one of the caller's groups'.
enum class MachineIn : std::uint8_t {
  Nowhere,  ///< it acts on none
  Name,     ///< `{name}` of the path
  Run,      ///< the machine of the run `{id}`
  Start,    ///< `machine` of the body that starts a run
  Port,     ///< the machine at the end of the port `{name}`
  Subject,  ///< `{subject}` where `{scope}` is machine
};

/// What a route has a body for.
enum class BodyKind : std::uint8_t {
  Text,     ///< JSON, TOML, or none
  Piece,    ///< of an upload
  Command,  ///< to a machine, which may be a stop
};

struct RoutePermission {
  std::string_view method, pattern;
  identity::Permission permission{};
  MachineIn machine = MachineIn::Nowhere;
  BodyKind body = BodyKind::Text;
};

/// What every route needs. A route that is not here ends the server when it starts.
std::span<const RoutePermission> route_permissions();
/// Null: there is no such row.
const RoutePermission* find_permission(std::string_view method, std::string_view pattern);

}  // namespace dripline::api
