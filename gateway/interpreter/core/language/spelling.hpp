#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "gateway/interpreter/core/language/expression.hpp"

/// Words of several letters in text whose blanks mean nothing, also within a word. `kKinds` is the
/// dialect's table of characters; the text ends with a character that is neither blank nor part of
/// a word.

namespace dripline::interpreter::language {

// What each byte of G-code text may be, as one table. A dialect begins with `printable_characters`
// and adds what is blank on its control and what ends a block.

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

template <class Meaning>
struct Spelling {
  std::string_view text;  ///< in capitals
  Meaning meaning;
};

/// A letter in capitals, any other character as it is.
template <const CharKinds& kKinds>
constexpr char capital(char c) {
  return kKinds[static_cast<unsigned char>(c)] == CharKind::Letter ? upper(c) : c;
}

/// Moves `at` past `word` when the text continues with it.
template <const CharKinds& kKinds>
bool take_word(const char*& at, std::string_view word) {
  const char* next = at;
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (i != 0) {
      while (kKinds[static_cast<unsigned char>(*next)] == CharKind::Blank) ++next;
    }
    if (capital<kKinds>(*next) != word[i]) return false;
    ++next;
  }
  at = next;
  return true;
}

/// The meaning of the first spelling in `table` that the text continues with; `at` moves past it.
/// The value of {} when there is none. A spelling must come before its own beginnings.
template <const CharKinds& kKinds, class Table>
auto take_spelling(const Table& table, const char*& at) -> decltype(table[0].meaning) {
  const char first = capital<kKinds>(*at);
  for (const auto& spelling : table) {
    if (spelling.text[0] == first && take_word<kKinds>(at, spelling.text)) return spelling.meaning;
  }
  return {};
}

/// The functions of one argument that the dialects with parameters know, each its own selection.
enum class Function : std::uint8_t {
  None,
  Sin,
  Cos,
  Tan,
  Asin,
  Acos,
  Atan,
  Sqrt,
  Abs,
  Int,
  Rnd,
  Ln,
  Exp,
  Round,
  Fix,
  Fup,
  Bin,
  Bcd,
  Pin,
  Pow,  ///< of two arguments
};

/// The functions that mean the same on all controls; a dialect computes the others itself
/// (Undefined).
inline Computed compute(Function function, double argument) {
  switch (function) {
    case Function::Sin:
      return sine(argument);
    case Function::Cos:
      return cosine(argument);
    case Function::Tan:
      return tangent(argument);
    case Function::Sqrt:
      return square_root(argument);
    case Function::Abs:
      return absolute(argument);
    case Function::Int:
      return integer_part(argument);
    case Function::Ln:
      return natural_logarithm(argument);
    case Function::Exp:
      return exponential(argument);
    case Function::Round:
      return rounded(argument);
    default:
      return {0, MathFault::Undefined};
  }
}

}  // namespace dripline::interpreter::language
