#pragma once

#include <string>
#include <string_view>

namespace dripline {

/// `text` with its control characters written as escapes (`\n`, `\x1b`), so that a log entry stays
/// one line and cannot control a terminal, whatever a name, a version or a reason from outside
/// holds. Text without control characters is unchanged.
std::string one_line(std::string_view text);

}  // namespace dripline
