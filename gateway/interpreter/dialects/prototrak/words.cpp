#include "gateway/interpreter/dialects/prototrak/words.hpp"

#include <cmath>

namespace dripline::interpreter::prototrak {
namespace {

constexpr std::uint8_t kMostDecimals = 22;  ///< powers of ten are exact up to there

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool begins_number(char c) {
  return is_digit(c) || c == '+' || c == '-' || c == '.';
}
bool is_axis_word(Address address) {
  return address <= Address::YO || address == Address::X || address == Address::Y ||
         address == Address::Z;
}

/// One token: words that run together without blanks.
class TokenReader {
 public:
  TokenReader(std::string_view block, std::size_t begin, std::size_t end)
      : block_(block), at_(begin), end_(end) {}

  /// False at a fault.
  bool read(std::vector<Word>& words) {
    while (at_ < end_) {
      Word word;
      word.column = static_cast<std::uint32_t>(at_);
      if (!read_address(word) || !read_number(word)) return false;
      read_tag(word);
      words.push_back(word);
    }
    return true;
  }
  WordFault fault() const { return fault_; }
  std::size_t at() const { return at_; }

 private:
  char peek(std::size_t ahead = 0) const { return at_ + ahead < end_ ? block_[at_ + ahead] : '\0'; }
  bool fail(WordFault fault) {
    fault_ = fault;
    return false;
  }

  bool read_address(Word& word) {
    const std::string_view rest = block_.substr(at_, end_ - at_);
    for (std::size_t i = 0; i < kAddressCount; ++i) {
      if (!rest.starts_with(kAddressNames[i])) continue;
      word.address = static_cast<Address>(i);
      at_ += kAddressNames[i].size();
      return true;
    }
    const char c = peek();
    const bool is_letter = c >= 'A' && c <= 'Z';
    return fail(is_letter ? WordFault::NotAWord : WordFault::Character);
  }

  bool read_number(Word& word) {
    WrittenNumber& number = word.number;
    if (peek() == '+' || peek() == '-') {
      number.is_negative = peek() == '-';
      ++at_;
    }
    for (; is_digit(peek()) || (peek() == '.' && !number.has_point); ++at_) {
      if (peek() == '.') {
        number.has_point = true;
        continue;
      }
      number.has_digits = true;
      // of decimals, those that a double does not hold; of the whole part none, for its size counts
      if (number.has_point && (number.digits >= 1e15 || number.decimals == kMostDecimals)) continue;
      number.digits = number.digits * 10 + (peek() - '0');
      if (number.has_point) ++number.decimals;
    }
    // CR- alone says "not connected".
    const bool is_bare_minus = word.address == Address::CR && number.is_negative;
    if (!number.has_digits && !is_bare_minus) return fail(WordFault::NoNumber);
    return true;
  }

  /// A letter directly after an axis value is its tag unless a number follows it.
  void read_tag(Word& word) {
    if (!is_axis_word(word.address) || (peek() != 'A' && peek() != 'I')) return;
    if (begins_number(peek(1))) return;
    word.tag = peek() == 'A' ? Tag::Absolute : Tag::Incremental;
    ++at_;
  }

  std::string_view block_;
  std::size_t at_, end_;
  WordFault fault_ = WordFault::None;
};

}  // namespace

double WrittenNumber::value(int implied) const {
  const double scale = std::pow(10.0, has_point ? decimals : implied);
  return (is_negative ? -digits : digits) / scale;
}

ReadWords read_words(std::string_view block, bool skips_unknown, int& skipped) {
  ReadWords read;
  for (std::size_t at = 0; at < block.size();) {
    if (block[at] == ' ') {
      ++at;
      continue;
    }
    const std::size_t end = std::min(block.find(' ', at), block.size());
    TokenReader token(block, at, end);
    std::vector<Word> words;
    if (token.read(words)) {
      read.words.insert(read.words.end(), words.begin(), words.end());
    } else if (skips_unknown) {
      ++skipped;
    } else {
      read.fault = token.fault();
      read.column = static_cast<std::uint32_t>(token.at());
      return read;
    }
    at = end;
  }
  return read;
}

}  // namespace dripline::interpreter::prototrak
