#include "protocol/serial/channel.hpp"

#include <charconv>

#include "protocol/serial/impl/channels.hpp"

namespace dripline::serial {

Result<std::unique_ptr<Channel>> open_channel(const std::string& address,
                                              const wire::LineSettings& settings,
                                              std::chrono::milliseconds limit) {
  const auto parsed = parse_address(address);
  if (!parsed) return fail(parsed.error());
  if (const auto* tty = std::get_if<TtyAddress>(&*parsed)) return open_tty(tty->path, settings);
  const auto& tcp = std::get<TcpAddress>(*parsed);
  return tcp.speaks_rfc2217 ? open_rfc2217(address, tcp, settings, limit)
                            : open_tcp(address, tcp, limit);
}

namespace {

constexpr std::size_t kMaxAddress = 255;

Result<std::uint16_t> parse_port(std::string_view address, std::string_view text) {
  unsigned long port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (text.empty() || error == std::errc::invalid_argument || end != text.data() + text.size())
    return fail(Errc::Syntax, "address '{}': '{}' is no port number", address, text);
  if (error != std::errc() || port < 1 || port > 65535)
    return fail(Errc::LimitExceeded, "address '{}': port {} is not 1 to 65535", address, text);
  return static_cast<std::uint16_t>(port);
}

Result<Address> parse_host_and_port(std::string_view address, std::string_view text,
                                    bool speaks_rfc2217) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos || colon == 0)
    return fail(Errc::Syntax, "address '{}' needs host:port", address);
  std::string_view host = text.substr(0, colon);
  if (host.front() == '[' && host.back() == ']') {
    host = host.substr(1, host.size() - 2);
  } else if (host.find(':') != std::string_view::npos) {
    return fail(Errc::Syntax, "address '{}': write an IPv6 address as [address]:port", address);
  }
  if (host.empty()) return fail(Errc::Syntax, "address '{}' has no host", address);
  const auto port = parse_port(address, text.substr(colon + 1));
  if (!port) return fail(port.error());
  return Address(TcpAddress{std::string(host), *port, speaks_rfc2217});
}

}  // namespace

Result<Address> parse_address(std::string_view text) {
  if (text.size() > kMaxAddress)
    return fail(Errc::LimitExceeded, "an address of {} bytes, at most {}", text.size(),
                kMaxAddress);
  if (text.find('\0') != std::string_view::npos)
    return fail(Errc::Syntax, "an address has no NUL character");
  constexpr std::string_view kTcp = "tcp://", kRfc2217 = "rfc2217://";
  if (text.starts_with(kTcp)) return parse_host_and_port(text, text.substr(kTcp.size()), false);
  if (text.starts_with(kRfc2217))
    return parse_host_and_port(text, text.substr(kRfc2217.size()), true);
  if (text.starts_with('/') && text.size() > 1) return Address(TtyAddress{std::string(text)});
  return fail(Errc::Syntax,
              "address '{}' is neither a device (/dev/...) nor tcp://host:port nor "
              "rfc2217://host:port",
              text);
}

}  // namespace dripline::serial
