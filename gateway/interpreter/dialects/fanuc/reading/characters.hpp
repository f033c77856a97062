#pragma once

#include "gateway/interpreter/core/language/characters.hpp"

/// What each byte of a program may be, as one table. A block ends with LF (and with a semicolon,
/// by option); CR, blanks, NUL and DEL of punched tapes mean nothing outside comments, so that
/// LF, CR LF and LF CR CR all end a block.
namespace dripline::interpreter::fanuc {

using language::CharKind;
using language::is_digit;
using language::upper;

inline constexpr language::CharKinds kCharKinds = [] {
  auto kinds = language::printable_characters();
  kinds[' '] = kinds['\t'] = kinds['\r'] = kinds[0] = kinds[0x7F] = CharKind::Blank;
  kinds['\n'] = CharKind::EndOfBlock;
  kinds['#'] = CharKind::Hash;
  return kinds;
}();

constexpr CharKind kind_of(char c) {
  return kCharKinds[static_cast<unsigned char>(c)];
}
constexpr bool is_blank(char c) {
  return kind_of(c) == CharKind::Blank;
}
constexpr bool is_letter(char c) {
  return kind_of(c) == CharKind::Letter;
}
/// The text must end with a LF.
inline const char* skip_blanks(const char* at) {
  while (is_blank(*at)) ++at;
  return at;
}

}  // namespace dripline::interpreter::fanuc
