#pragma once

#include <array>
#include <cstdint>

/// What each byte of G-code text may be, as one table. A dialect begins with `printable_characters`
/// and adds what is blank on its control and what ends a block.
namespace dripline::interpreter::language {

enum class CharKind : std::uint8_t {
  Bad,  ///< not text of the control
  Blank,
  EndOfBlock,
  Digit,
  Letter,
  Sign,
  Point,
  OpenComment,
  OpenBracket,
  Hash,   ///< of the controls that write variables with it
  Other,  ///< printable, legal only where a statement asks for it
};
using CharKinds = std::array<CharKind, 256>;

constexpr CharKinds printable_characters() {
  CharKinds kinds{};
  for (std::size_t c = 33; c < 127; ++c) kinds[c] = CharKind::Other;
  for (std::size_t c = '0'; c <= '9'; ++c) kinds[c] = CharKind::Digit;
  for (std::size_t c = 'A'; c <= 'Z'; ++c) kinds[c] = kinds[c + 32] = CharKind::Letter;
  kinds['+'] = kinds['-'] = CharKind::Sign;
  kinds['.'] = CharKind::Point;
  kinds['('] = CharKind::OpenComment;
  kinds['['] = CharKind::OpenBracket;
  return kinds;
}

constexpr bool is_digit(char c) {
  return static_cast<unsigned char>(c - '0') < 10;
}
/// `c` must be a letter.
constexpr char upper(char c) {
  return static_cast<char>(c & 0xDF);
}

}  // namespace dripline::interpreter::language
