#pragma once

#include <csignal>

namespace dripline::process {

/// Blocks SIGTERM, SIGINT and SIGHUP (the log file is reopened) in this thread and those that it
/// will start, so that one thread can wait for them (sigwait): no handler code, no races. Call
/// before any thread is started. SIGPIPE is ignored: a closed connection is an error of the write.
sigset_t block_stop_signals();

}  // namespace dripline::process
