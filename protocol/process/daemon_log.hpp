#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/base/result.hpp"

namespace dripline::process {

struct LogOptions {
  std::string file;            ///< empty: standard error
  std::string level = "info";  ///< debug, info, warn, error or off
  std::uint32_t max_mb = 10;   ///< then it becomes FILE.1 (its suffix kept), that FILE.2 ...
  std::uint32_t kept = 5;      ///< such older files
};

/// Makes spdlog's default logger: UTC offset, level and the message on one line, whatever it
/// contains. Call after umask, which decides the permissions of the file. Errors: Denied (another
/// level), Io (the file cannot be written).
Result<void> start_log(const std::string& program, const LogOptions& options);

/// Reopens the log file after another program has moved it. False: there is none. Any thread.
bool reopen_log();

/// Passes messages of a library to the log, ten lines in ten seconds, and counts the rest: data of
/// strangers must not fill the disk. Any thread.
void log_foreign(bool is_error, std::string_view text);

}  // namespace dripline::process
