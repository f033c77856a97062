#include "server/api/http_address.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <asio/ip/tcp.hpp>
#include <cerrno>
#include <charconv>
#include <system_error>

#include "protocol/base/descriptor.hpp"

namespace dripline::api {
namespace {

Result<std::uint16_t> parse_port(std::string_view text) {
  std::uint16_t port = 0;
  const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (ec != std::errc() || end != text.data() + text.size()) {
    return fail(Errc::Syntax, "port '{}' is not a number from 0 to 65535", text);
  }
  return port;
}

Result<void> read_host(HttpAddress& address) {
  if (address.host == "localhost") address.host = "127.0.0.1";
  in_addr v4{};
  in6_addr v6{};
  if (::inet_pton(AF_INET, address.host.c_str(), &v4) == 1) {
    constexpr std::uint32_t kLoopbackNet = 127;
    address.is_loopback = ntohl(v4.s_addr) >> 24 == kLoopbackNet;
    address.is_ipv6 = false;
    return {};
  }
  if (::inet_pton(AF_INET6, address.host.c_str(), &v6) == 1) {
    address.is_loopback = IN6_IS_ADDR_LOOPBACK(&v6) != 0;
    address.is_ipv6 = true;
    return {};
  }
  return fail(Errc::Syntax, "host '{}' is not an address of this computer or localhost",
              address.host);
}

}  // namespace

std::string HttpAddress::text() const {
  return is_ipv6 ? fmt::format("[{}]:{}", host, port) : fmt::format("{}:{}", host, port);
}

Result<HttpAddress> parse_http_address(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) {
    return fail(Errc::Syntax, "'{}' is not HOST:PORT", text);
  }
  const auto port = parse_port(text.substr(colon + 1));
  if (!port) return fail(port.error());
  std::string_view host = text.substr(0, colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
    host = host.substr(1, host.size() - 2);
  }
  HttpAddress address;
  address.host = std::string(host);
  address.port = *port;
  if (auto good = read_host(address); !good) return fail(good.error());
  return address;
}

Result<void> check_free(const HttpAddress& address) {
  if (address.port == 0) return {};
  const Descriptor socket(
      ::socket(address.is_ipv6 ? AF_INET6 : AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const int yes = 1;
  // As a server that listens does: connections that have ended keep no address occupied.
  ::setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  const asio::ip::tcp::endpoint place(asio::ip::make_address(address.host), address.port);
  int failed = ::bind(socket.get(), place.data(), static_cast<socklen_t>(place.size()));
  if (failed == 0) failed = ::listen(socket.get(), 1);
  if (failed == 0) return {};
  const int error = errno;
  if (error == EADDRINUSE) return fail(Errc::Busy, "{} is in use", address.text());
  const Errc code = error == EACCES || error == EPERM ? Errc::Denied : Errc::Io;
  return fail(code, "{} cannot be used: {}", address.text(),
              std::generic_category().message(error));
}

Result<void> check_exposure(const HttpAddress& address, bool has_tls) {
  if (address.is_loopback || has_tls) return {};
  return fail(Errc::Denied,
              "refusing to listen at {} without TLS: anybody on the network could read the token; "
              "give a certificate and a key, or listen at 127.0.0.1",
              address.text());
}

}  // namespace dripline::api
