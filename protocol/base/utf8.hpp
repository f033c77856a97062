#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace dripline {

/// Bytes of the well-formed UTF-8 character that begins `text`; 0 when it begins with none
/// (overlong forms, surrogates, values beyond U+10FFFF, a character cut off). `text` is not empty.
std::size_t utf8_length(std::string_view text);

/// `text` with its control characters written as escapes (`\n`, `\x1b`), so that a log entry stays
/// one line and cannot control a terminal, whatever a name, a version or a reason from outside
/// holds. Text without control characters is unchanged.
std::string one_line(std::string_view text);

}  // namespace dripline
