#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "protocol/serial/address.hpp"
#include "protocol/serial/channel.hpp"

namespace dripline::serial {

/// A port of a device server whose line settings the client sets. Opening negotiates, sets the line
/// and waits for the server's answers, all within `limit`. Errors: those of open_channel;
/// Unsupported (not an RFC 2217 server, or it set another value than requested, named).
Result<std::unique_ptr<Channel>> open_rfc2217(const std::string& name, const TcpAddress& address,
                                              const wire::LineSettings& settings,
                                              std::chrono::milliseconds limit);

}  // namespace dripline::serial
