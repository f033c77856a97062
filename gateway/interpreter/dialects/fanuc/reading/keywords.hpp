#pragma once

#include <cstdint>
#include <string_view>

#include "gateway/interpreter/core/language/spelling.hpp"

/// The words of custom macro B. Capitals or not; blanks within mean nothing.

namespace dripline::interpreter::fanuc {

enum class Keyword : std::uint8_t {
  None,
  If,
  Then,
  Goto,
  While,
  Do,
  End,
  Setvn,
  Popen,
  Pclos,
  Dprnt,
  Bprnt  // clang-format off
};  // clang-format on
using language::Function;
// clang-format on
/// 3 products and AND, 2 sums, OR and XOR, 1 comparisons, 0 none.
int rank(language::Operator op);

// Control words and functions may be cut to their first two letters or more where no letter
// follows: WH[..]DO1, GO9.

/// Moves `at` past `word` when the text continues with it.
bool take_word(const char*& at, std::string_view word);
Keyword take_keyword(const char*& at);
Function take_function(const char*& at);
/// The operator at `at`, and where it ends.
language::Operator operator_at(const char* at, const char*& after);

// What each byte of a program may be, as one table. A block ends with LF (and with a semicolon,
// by option); CR, blanks, NUL and DEL of punched tapes mean nothing outside comments, so that
// LF, CR LF and LF CR CR all end a block.

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
/// Of a program's name; small letters and capitals are different.
constexpr bool is_name_character(char c) {
  return is_letter(c) || is_digit(c) || c == '+' || c == '-' || c == '_' || c == '.';
}
inline constexpr std::size_t kMaxProgramName = 32;
/// The name of `<NAME>` at `at`, which moves past it. Empty, and `at` stays: there is none. The
/// text must end with a LF.
inline std::string_view take_program_name(const char*& at) {
  if (*at != '<') return {};
  const char* end = at + 1;
  while (is_name_character(*end)) ++end;
  if (*end != '>') return {};
  const std::string_view name(at + 1, static_cast<std::size_t>(end - at - 1));
  if (!name.empty()) at = end + 1;
  return name;
}

/// The text must end with a LF.
inline const char* skip_blanks(const char* at) {
  while (is_blank(*at)) ++at;
  return at;
}

}  // namespace dripline::interpreter::fanuc
