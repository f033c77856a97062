#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/base/result.hpp"

namespace dripline::api {

/// Where to listen, from `HOST:PORT`: an IPv4 address, an IPv6 address in brackets, or localhost.
struct HttpAddress {
  std::string host = "127.0.0.1";  ///< numeric
  std::uint16_t port = 8430;       ///< 0: any free one
  bool is_loopback = true;
  bool is_ipv6 = false;
  /// `127.0.0.1:8430`, `[::1]:8430`
  std::string text() const;
};
/// Errors: Syntax.
Result<HttpAddress> parse_http_address(std::string_view text);

/// Whether a server could listen there now; port 0 always. Errors: Busy (in use), Denied (no
/// permission), Io.
Result<void> check_free(const HttpAddress& address);

/// Errors: Denied (another machine can reach the address and there is no TLS: the token would cross
/// the network unencrypted).
Result<void> check_exposure(const HttpAddress& address, bool has_tls);

}  // namespace dripline::api
