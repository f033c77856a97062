#pragma once

#include <string>
#include <string_view>

namespace dripline {

/// `text` with its control characters written as escapes (`\n`, `\x1b`), so that a log entry stays
/// one line and a terminal that shows it does nothing else, whatever somebody put into a name, a
/// version or a reason. Text without any comes back unchanged.
std::string one_line(std::string_view text);

}  // namespace dripline
