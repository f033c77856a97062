#pragma once

#include <csignal>
#include <cstdint>

#include "protocol/base/result.hpp"

namespace dripline::process {

/// Blocks SIGTERM, SIGINT and SIGHUP (the log file is reopened) in this thread and those that it
/// will start, so that one thread can wait for them (sigwait): no handler code, no races. Call
/// before any thread is started. SIGPIPE is ignored: a closed connection is an error of the write.
sigset_t block_stop_signals();

/// The minimum for both daemons, without connections of clients: with fewer, opening DDS aborts the
/// process instead of returning an error.
inline constexpr std::uint64_t kServerFiles = 192, kGatewayFiles = 96;

/// Raises this process's limit of open files to `least` where that is permitted. Call before
/// anything is opened. Errors: LimitExceeded.
Result<void> require_open_files(std::uint64_t least);

}  // namespace dripline::process
