#pragma once

#include <span>
#include <string>
#include <string_view>

namespace dripline {

/// Lower-case hexadecimal digits, two a byte.
std::string hex_text(std::span<const std::byte> bytes);
/// False: not exactly two hexadecimal digits, of either case, for each byte of `to`.
bool parse_hex(std::string_view hex, std::span<std::byte> to);

}  // namespace dripline
