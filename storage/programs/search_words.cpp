#include "storage/programs/search_words.hpp"

#include <algorithm>

#include "protocol/base/utf8.hpp"

namespace dripline::storage {
namespace {

constexpr std::string_view kCoordinates = "xyzabcuvwijkqrn";

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
}

/// Small letters of ASCII, and of Latin-1 in UTF-8 (C3 80 to C3 9E).
std::string small(std::string_view letters) {
  std::string text(letters);
  constexpr unsigned char kLead = 0xC3;
  constexpr unsigned char kFirst = 0x80, kLast = 0x9E, kTimes = 0x97;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] >= 'A' && text[i] <= 'Z') text[i] = static_cast<char>(text[i] + ('a' - 'A'));
    if (i == 0 || static_cast<unsigned char>(text[i - 1]) != kLead) continue;
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte >= kFirst && byte <= kLast && byte != kTimes) text[i] = static_cast<char>(byte + 0x20);
  }
  return text;
}

class WordReader {
 public:
  WordReader(std::string_view text, WordsOf kind) : text_(text), kind_(kind) {}

  /// False: there are no more.
  bool next(std::string& word) {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\n' || c == '\r') {
        is_line_begin_ = true;
        is_comment_ = false;
      }
      if (c == '(' || c == ';') is_comment_ = true;
      if (c == ')') is_comment_ = false;
      const bool is_begin = is_line_begin_;
      if (is_letter(c) || is_number_at(at_)) {
        is_line_begin_ = false;
        const bool is_taken = is_letter(c) ? read_letters(word) : read_number_word(word, is_begin);
        if (is_taken && word.size() <= kMaxWord) return true;
      } else {
        if (c != ' ' && c != '\t' && c != '\n' && c != '\r' && c != '/') is_line_begin_ = false;
        ++at_;
      }
    }
    return false;
  }

 private:
  bool has_all_words() const { return kind_ == WordsOf::Card || is_comment_; }
  bool is_number_at(std::size_t at) const {
    if (at >= text_.size()) return false;
    return is_digit(text_[at]) ||
           (text_[at] == '.' && at + 1 < text_.size() && is_digit(text_[at + 1]));
  }

  /// A run of letters, or an address with its number. False: it is left out.
  bool read_letters(std::string& word) {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_letter(text_[at_])) ++at_;
    word = small(text_.substr(begin, at_ - begin));
    if (at_ - begin > 1) return true;
    std::size_t value = at_;
    const bool has_sign = value < text_.size() && (text_[value] == '-' || text_[value] == '+');
    if (has_sign) ++value;
    if (!is_number_at(value)) return has_all_words();
    const bool is_negative = has_sign && text_[at_] == '-';
    at_ = value;
    const std::string number = read_number();
    if (!has_all_words() && kCoordinates.find(word[0]) != std::string_view::npos) return false;
    if (is_negative) word += '-';
    word += number;
    return true;
  }

  bool read_number_word(std::string& word, bool is_begin_of_line) {
    word = read_number();
    return has_all_words() || !is_begin_of_line;
  }

  /// Without zeros that mean nothing; a comma between digits is a point.
  std::string read_number() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_digit(text_[at_])) ++at_;
    std::string_view whole = text_.substr(begin, at_ - begin);
    std::string_view fraction;
    if (at_ < text_.size() && (text_[at_] == '.' || text_[at_] == ',')) {
      const bool is_point = text_[at_] == '.';
      std::size_t end = at_ + 1;
      while (end < text_.size() && is_digit(text_[end])) ++end;
      if (is_point || end > at_ + 1) {
        fraction = text_.substr(at_ + 1, end - at_ - 1);
        at_ = end;
      }
    }
    while (whole.size() > 1 && whole[0] == '0') whole.remove_prefix(1);
    while (!fraction.empty() && fraction.back() == '0') fraction.remove_suffix(1);
    std::string number(whole.empty() ? std::string_view("0") : whole);
    if (!fraction.empty()) number.append(".").append(fraction);
    return number;
  }

  std::string_view text_;
  const WordsOf kind_;
  std::size_t at_ = 0;
  bool is_line_begin_ = true;
  bool is_comment_ = false;  ///< until the end of the line at most
};

Result<SearchTerm> beginning_of(const std::string& word) {
  if (is_word_of_letters(word)) return SearchTerm{word, true};
  return fail(Errc::Syntax, "'{}*': only a word of letters has a beginning, of {} at least", word,
              kFewestLetters);
}

/// Whole characters.
std::string shown(std::string_view line) {
  std::string text(line.substr(0, kMaxFoundText));
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(std::string_view(text).substr(i));
    if (length == 0) {
      text.resize(i);
      break;
    }
    i += length;
  }
  return one_line(text).substr(0, kMaxFoundText);
}

std::uint64_t terms_in(const std::set<std::string>& words, const std::vector<SearchTerm>& terms) {
  return static_cast<std::uint64_t>(std::ranges::count_if(terms, [&](const SearchTerm& term) {
    const auto found = words.lower_bound(term.word);
    if (found == words.end()) return false;
    return term.is_beginning ? found->starts_with(term.word) : *found == term.word;
  }));
}

}  // namespace

bool is_word_of_letters(std::string_view word) {
  return word.size() >= kFewestLetters && std::ranges::all_of(word, is_letter);
}

void add_search_words(std::string_view text, WordsOf kind, std::set<std::string>& words) {
  WordReader reader(text, kind);
  for (std::string word; reader.next(word);) words.insert(word);
}

Result<std::vector<SearchTerm>> parse_search(std::string_view query) {
  std::vector<SearchTerm> terms;
  for (std::size_t at = 0; at < query.size();) {
    const std::size_t blank = std::min(query.find_first_of(" \t\r\n", at), query.size());
    std::string_view part = query.substr(at, blank - at);
    at = blank + 1;
    const bool is_beginning = part.ends_with('*');
    std::vector<SearchTerm> of_part;
    WordReader reader(part, WordsOf::Card);
    for (std::string word; reader.next(word);) of_part.push_back({word, false});
    if (is_beginning && !of_part.empty()) {
      auto last = beginning_of(of_part.back().word);
      if (!last) return fail(last.error());
      of_part.back() = *std::move(last);
    }
    for (auto& term : of_part) {
      if (std::ranges::find(terms, term) == terms.end()) terms.push_back(std::move(term));
    }
    if (terms.size() > kMaxTerms)
      return fail(Errc::LimitExceeded, "more than {} words to search for", kMaxTerms);
  }
  if (terms.empty()) return fail(Errc::Syntax, "'{}' has no word to search for", query);
  return terms;
}

std::optional<FoundLine> find_line(std::string_view text, const std::vector<SearchTerm>& terms) {
  std::optional<FoundLine> best;
  std::uint64_t most = 0, number = 0;
  std::string_view line;
  std::set<std::string> words;
  for (std::size_t at = 0; at < text.size() && most < terms.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    line = text.substr(at, end - at);
    at = end + 1;
    ++number;
    words.clear();
    add_search_words(line, WordsOf::Text, words);
    const std::uint64_t found = terms_in(words, terms);
    if (found <= most) continue;
    most = found;
    if (line.ends_with('\r')) line.remove_suffix(1);
    best = FoundLine{number, std::string(line)};
  }
  if (best) best->text = shown(best->text);
  return best;
}

}  // namespace dripline::storage
