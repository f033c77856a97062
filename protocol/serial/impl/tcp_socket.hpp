#pragma once

#include <chrono>

#include "protocol/base/descriptor.hpp"
#include "protocol/base/name_lookup.hpp"
#include "protocol/serial/channel.hpp"

namespace dripline::serial {

/// A connected, non-blocking socket that notices a dead peer within about ten seconds, and sends
/// each character at once. Waits at most `limit` in all, for the name server too. Errors: NotFound
/// (the name), Timeout, LimitExceeded (lookups), Io.
Result<Descriptor> connect_tcp(const TcpAddress& address, std::chrono::milliseconds limit,
                               const NameLookup& lookup);

/// True when the descriptor is ready for `events` before the time is over.
bool wait_for(int descriptor, short events, std::chrono::steady_clock::time_point end);

}  // namespace dripline::serial
