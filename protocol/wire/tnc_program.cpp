#include "protocol/wire/tnc_program.hpp"

#include <array>
#include <charconv>

namespace dripline::wire {
namespace {

constexpr std::size_t kMaxNumber = 8;  // digits of a program number

std::string_view next_word(std::string_view& rest) {
  while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
  const auto word = rest.substr(0, rest.find(' '));
  rest.remove_prefix(word.size());
  return word;
}

bool is_digits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
}

/// "%7" or "%7G71": the digits.
std::string iso_program(std::string_view word) {
  const auto digits = word.substr(1, word.find_first_not_of("0123456789", 1) - 1);
  return digits.size() <= kMaxNumber ? std::string(digits) : std::string();
}

}  // namespace

TncLine read_tnc_line(std::string_view line) {
  TncLine read;
  auto rest = line;
  auto word = next_word(rest);
  if (word.starts_with('%') && word.size() > 1) {
    read.program = iso_program(word);
    if (!read.program.empty()) read.kind = TncLineKind::Begin;
    return read;
  }
  if (word == "N9999" || word == "N99999999") {
    word = next_word(rest);
    if (word.starts_with('%') && word.size() > 1) read.program = iso_program(word);
    if (!read.program.empty()) read.kind = TncLineKind::End;
    return read;
  }
  if (unsigned number = 0; is_digits(word)) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error == std::errc{}) read.number = number;
  }
  if (!read.number) return read;
  word = next_word(rest);
  if ((word != "BEGIN" && word != "END") || next_word(rest) != "PGM") return read;
  const auto program = next_word(rest);
  if (!is_digits(program) || program.size() > kMaxNumber) return read;
  read.kind = word == "BEGIN" ? TncLineKind::Begin : TncLineKind::End;
  read.program = program;
  return read;
}

bool is_numbered(std::string_view line) {
  if (line.starts_with('N')) line.remove_prefix(1);
  return !line.empty() && line.front() >= '0' && line.front() <= '9';
}

}  // namespace dripline::wire
