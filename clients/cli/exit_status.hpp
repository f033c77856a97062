#pragma once

#include "clients/lib/reply.hpp"

namespace dripline::cli {

/// What `dnc` exits with; documented in `dnc --help` and README.md, never renumbered.
inline constexpr int kExitOk = 0;
inline constexpr int kExitNo = 1;           ///< the program, the run or the server said no
inline constexpr int kExitUsage = 2;        ///< usage, unreadable file, unknown control
inline constexpr int kExitUnreachable = 3;  ///< no server, or not a Dripline server
inline constexpr int kExitDenied = 4;       ///< the server does not accept the token
inline constexpr int kExitClosedPipe =
    141;  ///< nobody reads standard output any more, as for SIGPIPE
inline constexpr int kExitInterrupted = 130;  ///< Ctrl-C

int exit_status(const client::Failure& failure);

/// Prints "dnc: ..." on standard error and gives the status to exit with.
int complain(const client::Failure& failure);
int complain(const Error& error);

}  // namespace dripline::cli
