#pragma once

#include <cstdint>

namespace dripline::webhooks {

/// How many bytes have come over a TCP connection, also those that were not read yet. 0: not
/// known, or `socket` is none. Any thread.
std::uint64_t bytes_received(int socket);

}  // namespace dripline::webhooks
