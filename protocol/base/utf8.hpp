#pragma once

#include <cstddef>
#include <string_view>

namespace dripline {

/// Bytes of the well-formed UTF-8 character that begins `text`; 0 when it begins with none
/// (overlong forms, surrogates, values beyond U+10FFFF, a character cut off). `text` is not empty.
std::size_t utf8_length(std::string_view text);

}  // namespace dripline
