#pragma once

#include <string>

#include "protocol/base/result.hpp"

namespace dripline::process {

/// Makes spdlog's default logger: UTC offset, level and the message on one line, whatever is in it.
/// `file` empty: standard error. `level`: debug, info, warn, error or off. Errors: Denied (another
/// level), Io (the file can not be written).
Result<void> start_log(const std::string& program, const std::string& file,
                       const std::string& level);

}  // namespace dripline::process
