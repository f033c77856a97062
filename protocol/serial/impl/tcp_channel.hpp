#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "protocol/serial/address.hpp"
#include "protocol/serial/channel.hpp"

namespace dripline::serial {

/// The characters of a line as a TCP stream, as device servers offer it in raw mode; rate and
/// parity are set at the device server by hand. Errors: those of open_channel.
Result<std::unique_ptr<Channel>> open_tcp(const std::string& name, const TcpAddress& address,
                                          std::chrono::milliseconds limit);

}  // namespace dripline::serial
