#pragma once

#include <array>
#include <cstdint>

/// What each byte of a program may be, as one table. A block ends with LF (and with a semicolon,
/// by option); CR, blanks, NUL and DEL of punched tapes mean nothing outside comments, so that
/// LF, CR LF and LF CR CR all end a block.
namespace dripline::interpreter::fanuc {

enum class CharKind : std::uint8_t {
  Bad,
  Blank,
  EndOfBlock,
  Digit,
  Letter,
  Sign,
  Point,
  OpenComment,
  OpenBracket,
  Hash,
  Other,  ///< printable, legal only where a statement asks for it
};

namespace detail {
constexpr std::array<CharKind, 256> char_kinds() {
  std::array<CharKind, 256> kinds{};
  for (std::size_t c = 33; c < 127; ++c) kinds[c] = CharKind::Other;
  for (std::size_t c = '0'; c <= '9'; ++c) kinds[c] = CharKind::Digit;
  for (std::size_t c = 'A'; c <= 'Z'; ++c) kinds[c] = kinds[c + 32] = CharKind::Letter;
  kinds[' '] = kinds['\t'] = kinds['\r'] = kinds[0] = kinds[0x7F] = CharKind::Blank;
  kinds['\n'] = CharKind::EndOfBlock;
  kinds['+'] = kinds['-'] = CharKind::Sign;
  kinds['.'] = CharKind::Point;
  kinds['('] = CharKind::OpenComment;
  kinds['['] = CharKind::OpenBracket;
  kinds['#'] = CharKind::Hash;
  return kinds;
}
}  // namespace detail

inline constexpr std::array<CharKind, 256> kCharKinds = detail::char_kinds();

constexpr CharKind kind_of(char c) {
  return kCharKinds[static_cast<unsigned char>(c)];
}
constexpr bool is_blank(char c) {
  return kind_of(c) == CharKind::Blank;
}
constexpr bool is_digit(char c) {
  return static_cast<unsigned char>(c - '0') < 10;
}
constexpr bool is_letter(char c) {
  return kind_of(c) == CharKind::Letter;
}
/// Only of a letter.
constexpr char upper(char c) {
  return static_cast<char>(c & 0xDF);
}
/// The text must end with a LF.
inline const char* skip_blanks(const char* at) {
  while (is_blank(*at)) ++at;
  return at;
}

}  // namespace dripline::interpreter::fanuc
