#pragma once

#include <charconv>
#include <string_view>

/// What operators' commands consist of: words with one space between.
namespace dripline::interpreter {

/// The first word of `text`, in which the rest stays.
inline std::string_view take_word(std::string_view& text) {
  const std::size_t end = text.find(' ');
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return word;
}

/// False: it is no number, or has something after it.
template <class Number>
bool read_number(std::string_view word, Number& number) {
  const char* const end = word.data() + word.size();
  const auto done = std::from_chars(word.data(), end, number);
  return done.ec == std::errc{} && done.ptr == end && !word.empty();
}

}  // namespace dripline::interpreter
