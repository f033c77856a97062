#pragma once

#include <cstddef>
#include <optional>

#include "protocol/wire/line_settings.hpp"

/// Characters that control a line, as they are on the line in its code.
namespace dripline::wire {

inline constexpr char kDc1 = 0x11, kDc2 = 0x12, kDc3 = 0x13, kDc4 = 0x14;

/// People see printable characters (`%`) as part of a program's text, the others not.
constexpr bool is_printable(char character) {
  return character > ' ' && character < 0x7f;
}

/// The character on the line; nullopt: the code does not have it.
std::optional<std::byte> to_line(CharacterCode code, char character);
/// Its 7-bit character; nullopt: wrong parity, or EIA, which has no control characters except those
/// of tape ('%' for its rewind stop).
std::optional<char> from_line(CharacterCode code, std::byte character);

}  // namespace dripline::wire
