#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "protocol/serial/channel.hpp"

/// The kinds of channel. Errors of all: those of open_channel.
namespace dripline::serial {

/// A local tty: a UART, a USB adapter, or a pty.
Result<std::unique_ptr<Channel>> open_tty(const std::string& path,
                                          const wire::LineSettings& settings);

/// The characters of a line as a TCP stream, as device servers offer it in raw mode; rate and
/// parity are set at the device server by hand.
Result<std::unique_ptr<Channel>> open_tcp(const std::string& name, const TcpAddress& address,
                                          std::chrono::milliseconds limit);

/// A port of a device server whose line settings the client sets. Opening negotiates, sets the line
/// and waits for the server's answers, all within `limit`. Errors also: Unsupported (not an RFC
/// 2217 server, or it set another value than requested, named).
Result<std::unique_ptr<Channel>> open_rfc2217(const std::string& name, const TcpAddress& address,
                                              const wire::LineSettings& settings,
                                              std::chrono::milliseconds limit);

}  // namespace dripline::serial
