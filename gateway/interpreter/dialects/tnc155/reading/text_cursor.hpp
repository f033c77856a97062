#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "gateway/interpreter/dialects/tnc155/errors.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/reading_state.hpp"

namespace dripline::interpreter::tnc155 {

/// The permitted values of a number, in steps of a Value.
struct Range {
  std::int64_t low = 0;
  std::int64_t high = 0;
  bool is_whole = false;  ///< no decimals
  bool may_be_q = true;
  bool is_degrees = false;  ///< three decimals, in inch programs as well
};

/// Bits for what a character can begin.
inline constexpr std::uint8_t kDigitBit = 1;
inline constexpr std::uint8_t kValueBit = 2;  ///< sign, digit, decimal sign, Q
inline constexpr std::uint8_t kAxisBit = 4;
inline constexpr auto kCharacterBits = [] {
  std::array<std::uint8_t, 256> bits{};
  for (const char c : std::string_view("0123456789")) {
    bits[static_cast<unsigned char>(c)] = kDigitBit | kValueBit;
  }
  for (const char c : std::string_view("+-,.Q")) bits[static_cast<unsigned char>(c)] = kValueBit;
  for (const char c : std::string_view("XYZABCUVW")) bits[static_cast<unsigned char>(c)] = kAxisBit;
  return bits;
}();
inline bool is_axis_letter(char c) {
  return (kCharacterBits[static_cast<unsigned char>(c)] & kAxisBit) != 0;
}

/// Reads the words of one block from left to right; blanks and line ends between two characters are
/// ignored. `*end` is readable and not a character of a word. A function that returns false has put
/// the reason into the fault.
class TextCursor {
 public:
  TextCursor(const char* begin, const char* end, const ProgramForm& form, Fault& fault)
      : begin_(begin), at_(begin), end_(end), form_(&form), fault_(&fault) {}

  /// The next significant character; at the end of the block that is `*end`.
  char peek() {
    while (*at_ == ' ') ++at_;
    if (static_cast<unsigned char>(*at_) < ' ' && at_ != end_) skip_controls();
    return *at_;
  }
  bool is_at_end() { return peek(), at_ == end_; }
  void advance() { ++at_; }
  const char* at() const { return at_; }
  void back_to(const char* at) { at_ = at; }

  bool take(char c) {
    if (peek() != c || at_ == end_) return false;
    ++at_;
    return true;
  }
  /// Takes a word of capitals and points; blanks are ignored, here and in the text. Takes nothing
  /// where the text has another word.
  bool take(std::string_view word) {
    const char* start = at_;
    for (const char c : word) {
      if (c != ' ' && !take(c)) {
        at_ = start;
        return false;
      }
    }
    return true;
  }
  bool is_digit_next() { return is_digit(peek()); }
  /// A sign, a digit, a decimal sign or a Q comes next.
  bool is_value_next() {
    return (kCharacterBits[static_cast<unsigned char>(peek())] & kValueBit) != 0;
  }

  /// Digits without sign. `name` is what the fault calls it.
  bool read_integer(std::int32_t& value, std::int32_t low, std::int32_t high,
                    std::string_view name) {
    peek();
    const char* start = at_;
    std::int64_t number = take_digits();
    if (at_ == start) return missing(name);
    if (number < low || number > high) return out_of_range(start, name, low, high);
    value = static_cast<std::int32_t>(number);
    return true;
  }

  /// A number with its sign, or a Q parameter with its sign.
  bool read_value(Value& value, const Range& range, std::string_view name) {
    const char first = peek();
    const char* start = at_;
    const bool is_negative = first == '-';
    if (is_negative || first == '+') {
      ++at_;
      peek();
    }
    if (*at_ == 'Q') return read_q(value, is_negative, range, name, start);
    std::int64_t steps = 0;
    if (!read_steps(steps, name)) return false;
    if (is_negative) steps = -steps;
    if (steps < range.low || steps > range.high || (range.is_whole && steps % kSteps != 0) ||
        (range.is_degrees && steps % kDegreeSteps != 0)) {
      return outside(start, name, range, steps);
    }
    value = Value::steps(static_cast<std::int32_t>(steps));
    return true;
  }
  /// A run of up to so many digits (9 at most) with no decimal sign after it; else nothing is
  /// taken.
  bool read_short_integer(std::int32_t& value, int max_digits = 5) {
    peek();
    const char* start = at_;
    std::int32_t number = 0;
    while (is_digit(*at_) && at_ - start < max_digits) number = number * 10 + (*at_++ - '0');
    value = number;
    if (at_ != start && !is_digit(*at_) && *at_ != ',' && *at_ != '.') return true;
    at_ = start;
    return false;
  }
  /// Skips what looks like a value.
  void skip_value() {
    while (is_value_next()) ++at_;
  }
  /// A number without sign in millionths.
  bool read_millionths(std::int32_t& value, std::int32_t high, std::string_view name);

  [[gnu::cold]] bool wrong(ErrorCode code, const char* at, std::string detail);
  [[gnu::cold]] bool wrong(std::string detail) {
    return wrong(ErrorCode::BlockFormatIncorrect, at_, std::move(detail));
  }
  [[gnu::cold]] bool missing(std::string_view name);
  /// The block is over; a fault where it is not.
  bool ends() { return is_at_end() || unexpected(); }
  /// There is text where the block should end.
  [[gnu::cold]] bool unexpected();

  const ProgramForm& form() const { return *form_; }
  const char* begin() const { return begin_; }
  Fault& fault() { return *fault_; }
  bool is_inch() const { return form_->units == Units::Inch; }

  static constexpr std::int64_t kSteps = Value::kStepsPerUnit;
  static constexpr std::int64_t kDegreeSteps = 10;  ///< a thousandth of a degree
  static bool is_digit(char c) { return static_cast<unsigned char>(c - '0') < 10; }

 private:
  void skip_controls();
  bool read_q(Value& value, bool is_negated, const Range& range, std::string_view name,
              const char* start);

  /// A run of digits, perhaps empty; more than any range allows becomes kTooLong.
  [[gnu::always_inline]] std::int64_t take_digits() {
    const char* at = at_;
    std::uint64_t number = 0;
    for (unsigned digit = 0; (digit = static_cast<unsigned char>(*at) - unsigned{'0'}) < 10; ++at) {
      number = number * 10 + digit;
    }
    const bool is_long = at - at_ > 9;
    const char* start = at_;
    at_ = at;
    return is_long ? long_number(start) : static_cast<std::int64_t>(number);
  }
  [[gnu::cold]] std::int64_t long_number(const char* start) const;

  /// Digits with up to as many decimals as the program's units have.
  [[gnu::always_inline]] bool read_steps(std::int64_t& steps, std::string_view name) {
    static constexpr std::uint32_t kScale[]{10'000, 1'000, 100, 10, 1};
    const char* start = at_;
    steps = take_digits() * kSteps;
    const char* at = at_;
    if (*at == ',' || *at == '.') {
      const char* decimals = ++at;
      std::uint32_t fraction = 0;
      for (; is_digit(*at); ++at) fraction = fraction * 10 + static_cast<unsigned char>(*at - '0');
      const auto count = at - decimals;
      at_ = at;
      if (count == 0 && decimals == start + 1) return at_ = start, missing(name);
      if (count > 4) return read_many_decimals(start, decimals, steps, name);
      steps += fraction * kScale[count];
      return count < 4 || fraction % 10 == 0 || is_inch() || too_fine(start, name);
    }
    return at == start ? missing(name) : true;
  }
  /// Adds the significant decimals; only zeros may follow them.
  [[gnu::cold]] bool read_many_decimals(const char* start, const char* decimals,
                                        std::int64_t& steps, std::string_view name);
  [[gnu::cold]] bool too_fine(const char* start, std::string_view name);
  [[gnu::cold]] bool out_of_range(const char* start, std::string_view name, std::int64_t low,
                                  std::int64_t high);
  [[gnu::cold]] bool outside(const char* start, std::string_view name, const Range& range,
                             std::int64_t steps);
  std::string word_at(const char* start) const;

  const char* begin_;
  const char* at_;
  const char* end_;
  const ProgramForm* form_;
  Fault* fault_;
};

}  // namespace dripline::interpreter::tnc155
