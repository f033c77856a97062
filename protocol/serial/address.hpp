#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "protocol/base/result.hpp"

namespace dripline::serial {

struct TtyAddress {
  std::string path;
  friend bool operator==(const TtyAddress&, const TtyAddress&) = default;
};
struct TcpAddress {
  std::string host;  ///< name or number; an IPv6 address without brackets
  std::uint16_t port = 0;
  bool speaks_rfc2217 = false;
  friend bool operator==(const TcpAddress&, const TcpAddress&) = default;
};
using Address = std::variant<TtyAddress, TcpAddress>;

/// "/dev/ttyUSB0", "tcp://moxa-3:4001", "rfc2217://[fd00::3]:4001". Pure.
/// Errors: Syntax (naming the expected form), LimitExceeded (port not 1 to 65535).
Result<Address> parse_address(std::string_view text);

}  // namespace dripline::serial
