#pragma once

#include "clients/lib/reply.hpp"

namespace dripline::cli {

/// The exit statuses of `dnc`; documented in `dnc --help` and README.md, never renumbered.
inline constexpr int kExitOk = 0;
inline constexpr int kExitNo = 1;           ///< the program, the run or the server refused
inline constexpr int kExitUsage = 2;        ///< usage, unreadable file, unknown control
inline constexpr int kExitUnreachable = 3;  ///< no server, or not a Dripline server
inline constexpr int kExitDenied =
    4;  ///< the server does not accept the token, or it may not do this
inline constexpr int kExitTimeout = 124;  ///< --timeout has passed, as timeout(1) has it
inline constexpr int kExitClosedPipe =
    141;  ///< standard output has no reader any more, as for SIGPIPE
inline constexpr int kExitInterrupted = 130;  ///< Ctrl-C

int exit_status(const client::Failure& failure);

/// Prints "dnc: ..." on standard error and gives the status to exit with.
int complain(const client::Failure& failure);
int complain(const Error& error);

}  // namespace dripline::cli
