#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.hpp"

/// The words of the full-text index, and of what is searched for. Pure. NC text is not prose:
/// blocks are written together and numbers in several forms, so `G01X10.M06` has the words g1 and
/// m6. Runs of letters are words (small letters of Latin-1, too); an address is a word with its
/// number, without zeros that mean nothing.
namespace dripline::storage {

enum class WordsOf : std::uint8_t {
  Card,  ///< names, comments, fields: all words
  /// A program: without coordinates (X Y Z A B C U V W I J K Q R), N numbers and the number that
  /// begins a line: no one searches for them, and they would be most of the index. Of a comment,
  /// `(...)` or from `;` to the end of the line, all words.
  Text,
};

inline constexpr std::size_t kMaxWord = 64;  ///< bytes; longer ones are left out

/// `rou*` is looked for among these.
inline constexpr std::size_t kFewestLetters = 3;
bool is_word_of_letters(std::string_view word);

/// Adds the words of `text`.
void add_search_words(std::string_view text, WordsOf kind, std::set<std::string>& words);

struct SearchTerm {
  std::string word;
  bool is_beginning = false;  ///< `rou*`
  friend bool operator==(const SearchTerm&, const SearchTerm&) = default;
};
inline constexpr std::size_t kMaxTerms = 16;

/// What a user types; every term must be found. Errors: Syntax (no word in it, a beginning of fewer
/// than three letters or with a number), LimitExceeded (kMaxTerms).
Result<std::vector<SearchTerm>> parse_search(std::string_view query);

struct FoundLine {
  std::uint64_t line = 0;  ///< 1, 2, 3 ...
  std::string text;        ///< without control characters, at most kMaxFoundText bytes
};
inline constexpr std::size_t kMaxFoundText = 160;

/// The first of the lines that have the most of the terms; absent: no line has one.
std::optional<FoundLine> find_line(std::string_view text, const std::vector<SearchTerm>& terms);

}  // namespace dripline::storage
