#pragma once

#include <chrono>

#include "protocol/base/descriptor.hpp"
#include "protocol/serial/channel.hpp"

namespace dripline::serial {

/// A connected, non-blocking socket that notices a dead peer within about ten seconds, and sends
/// each character at once. The name is looked up by the system's resolver, whose own limits apply;
/// connecting waits at most `limit` in all. Errors: NotFound (the name), Timeout, Io.
Result<Descriptor> connect_tcp(const TcpAddress& address, std::chrono::milliseconds limit);

/// True when the descriptor is ready for `events` before the time is over.
bool wait_for(int descriptor, short events, std::chrono::steady_clock::time_point end);

}  // namespace dripline::serial
