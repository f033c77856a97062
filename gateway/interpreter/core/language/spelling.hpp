#pragma once

#include <string_view>

#include "gateway/interpreter/core/language/characters.hpp"

/// Words of several letters in text whose blanks mean nothing, also within a word. `kKinds` is the
/// dialect's table of characters; the text ends with a character that is neither blank nor part of
/// a word.
namespace dripline::interpreter::language {

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

}  // namespace dripline::interpreter::language
