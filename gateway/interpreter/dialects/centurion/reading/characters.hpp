#pragma once

#include <array>
#include <cstdint>

/// What each byte of a program may be, as one table. A block ends with CR, LF or CR LF; blanks
/// carry no information; letters count in either case. Source: manual section 1.4 (spec 3.1).
namespace dripline::interpreter::centurion {

enum class CharKind : std::uint8_t {
  Bad,  ///< NUL, control codes, above 127: not text of this control
  Blank,
  EndOfBlock,
  Digit,
  Letter,
  Sign,
  Point,
  OpenComment,
  OpenBracket,
  Other,  ///< printable, legal only where a statement asks for it
};

namespace detail {
constexpr std::array<CharKind, 256> char_kinds() {
  std::array<CharKind, 256> kinds{};
  for (std::size_t c = 33; c < 127; ++c) kinds[c] = CharKind::Other;
  for (std::size_t c = '0'; c <= '9'; ++c) kinds[c] = CharKind::Digit;
  for (std::size_t c = 'A'; c <= 'Z'; ++c) kinds[c] = kinds[c + 32] = CharKind::Letter;
  kinds[' '] = kinds['\t'] = CharKind::Blank;
  kinds['\r'] = kinds['\n'] = CharKind::EndOfBlock;
  kinds['+'] = kinds['-'] = CharKind::Sign;
  kinds['.'] = CharKind::Point;
  kinds['('] = CharKind::OpenComment;
  kinds['['] = CharKind::OpenBracket;
  return kinds;
}
}  // namespace detail

inline constexpr std::array<CharKind, 256> kCharKinds = detail::char_kinds();

constexpr CharKind kind_of(char c) {
  return kCharKinds[static_cast<unsigned char>(c)];
}
constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t';
}
constexpr bool is_end_of_block(char c) {
  return c == '\n' || c == '\r';
}
constexpr bool is_digit(char c) {
  return static_cast<unsigned char>(c - '0') < 10;
}
/// Only of a letter.
constexpr char upper(char c) {
  return static_cast<char>(c & 0xDF);
}
inline const char* skip_blanks(const char* at) {
  while (is_blank(*at)) ++at;
  return at;
}

}  // namespace dripline::interpreter::centurion
