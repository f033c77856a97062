#pragma once

#include <memory>
#include <string>

#include "protocol/serial/channel.hpp"

namespace dripline::serial {

/// A local tty: a UART, a USB adapter, or a pty. Errors: those of open_channel.
Result<std::unique_ptr<Channel>> open_tty(const std::string& path,
                                          const wire::LineSettings& settings);

}  // namespace dripline::serial
