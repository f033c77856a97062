#pragma once

#include "gateway/interpreter/core/language/characters.hpp"

/// The characters of this control: a block ends with CR, LF or CR LF; blanks carry no information;
/// letters may be small or capital. (Manual, section 1.4.)
namespace dripline::interpreter::centurion {

using language::CharKind;
using language::is_digit;
using language::upper;

inline constexpr language::CharKinds kCharKinds = [] {
  auto kinds = language::printable_characters();
  kinds[' '] = kinds['\t'] = CharKind::Blank;
  kinds['\r'] = kinds['\n'] = CharKind::EndOfBlock;
  return kinds;
}();

constexpr CharKind kind_of(char c) {
  return kCharKinds[static_cast<unsigned char>(c)];
}
constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t';
}
constexpr bool is_end_of_block(char c) {
  return c == '\n' || c == '\r';
}
inline const char* skip_blanks(const char* at) {
  while (is_blank(*at)) ++at;
  return at;
}

}  // namespace dripline::interpreter::centurion
