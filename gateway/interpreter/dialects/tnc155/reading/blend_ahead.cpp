#include "gateway/interpreter/dialects/tnc155/reading/blend_ahead.hpp"

#include "gateway/interpreter/core/language/spelling.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

std::size_t skip_blanks(std::string_view text, std::size_t at) {
  while (at < text.size() && static_cast<unsigned char>(text[at]) <= ' ') ++at;
  return at;
}

bool begins_as_blend(std::string_view text) {
  std::size_t at = skip_blanks(text, 0);
  // the slash of a block that may be skipped
  while (at < text.size() && (language::is_digit(text[at]) || text[at] == ' ' || text[at] == '/'))
    ++at;
  if (at == text.size()) return false;
  if (text[at] == 'R' || text.substr(at, 3) == "CHF") return true;
  if (text[at] != 'L') return false;
  at = skip_blanks(text, at + 1);
  if (at == text.size()) return false;
  const char next = text[at];
  return language::is_digit(next) || next == '+' || next == '-' || next == ',' || next == '.' ||
         next == 'Q';
}

/// G24 to G27 may be anywhere in a block.
bool has_iso_blend(std::string_view text) {
  for (std::size_t at = text.find('G'); at != std::string_view::npos; at = text.find('G', at + 1)) {
    std::size_t tens = skip_blanks(text, at + 1);
    while (tens != text.size() && text[tens] == '0') tens = skip_blanks(text, tens + 1);
    if (tens == text.size() || text[tens] != '2') continue;
    const std::size_t ones = skip_blanks(text, tens + 1);
    if (ones != text.size() && text[ones] >= '4' && text[ones] <= '7') return true;
  }
  return false;
}

}  // namespace

bool may_be_blend(std::string_view text, Form form) {
  return form == Form::Iso ? has_iso_blend(text) : begins_as_blend(text);
}

}  // namespace dripline::interpreter::tnc155
