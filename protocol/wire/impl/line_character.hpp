#pragma once

#include <cstddef>
#include <optional>

#include "protocol/wire/line_settings.hpp"

/// Characters that steer a line, as they stand on it in the line's code.
namespace dripline::wire {

inline constexpr char kDc1 = 0x11, kDc2 = 0x12, kDc3 = 0x13, kDc4 = 0x14;

/// Printable characters are part of a program's text in the eyes of people (`%`); the others are
/// not.
constexpr bool is_printable(char character) {
  return character > ' ' && character < 0x7f;
}

/// As it stands on the line; nullopt: the code does not have it.
std::optional<std::byte> to_line(CharacterCode code, char character);
/// The 7-bit character that stands for it; nullopt: wrong parity, or EIA, which has no control
/// characters but those of tape ('%' for its rewind stop).
std::optional<char> from_line(CharacterCode code, std::byte character);

}  // namespace dripline::wire
