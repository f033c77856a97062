#include "protocol/serial/channel.hpp"

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

}  // namespace dripline::serial
