#pragma once

#include <string>
#include <string_view>

namespace dripline::dds {

/// Well-formed UTF-8 (no overlong forms, surrogates or values beyond U+10FFFF) without NUL, which a
/// DDS string cannot carry.
bool is_sendable_text(std::string_view text);

/// The text with every byte that cannot be sent written as \xNN, cut at a character and ended with
/// "…" when longer than `limit` bytes (at least 8). Valid text that fits is unchanged.
std::string make_sendable(std::string_view text, std::size_t limit);

}  // namespace dripline::dds
