#pragma once

#include <charconv>
#include <cmath>
#include <string_view>

#include "protocol/base/lines.hpp"

/// Parts of a block's text, for what looks through programs.
namespace dripline::line {

inline char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
inline bool is_letter(char c) {
  return upper(c) >= 'A' && upper(c) <= 'Z';
}
inline bool is_of_number(char c) {
  return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+';
}

inline std::string_view without_blanks(std::string_view text) {
  return trimmed(text, " \t\r");
}

/// A block without the N number at its beginning.
inline std::string_view without_number(std::string_view block) {
  if (block.empty() || upper(block.front()) != 'N') return block;
  const auto end = block.find_first_not_of("0123456789", 1);
  return end == std::string_view::npos ? std::string_view() : without_blanks(block.substr(end));
}

/// G54.1 is 541; -1: no code.
inline int tenths(std::string_view value) {
  double number = 0;
  const auto read = std::from_chars(value.data(), value.data() + value.size(), number);
  if (read.ec != std::errc{} || number < 0 || number > 999) return -1;
  return static_cast<int>(std::lround(number * 10));
}

}  // namespace dripline::line
