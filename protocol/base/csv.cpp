#include "protocol/base/csv.hpp"

#include <algorithm>

namespace dripline {
namespace {

bool is_plain_number(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789";
  if (!text.empty() && (text.front() == '+' || text.front() == '-')) text.remove_prefix(1);
  return text.find_first_of(kDigits) != std::string_view::npos &&
         text.find_first_not_of("0123456789.") == std::string_view::npos &&
         std::ranges::count(text, '.') <= 1;
}

/// Apostrophes before it do not matter, so that those of a text itself come back; quotes neither,
/// for a spreadsheet that is lenient drops them.
bool looks_like_formula(std::string_view text, std::string_view starts) {
  text.remove_prefix(std::min(text.find_first_not_of("'\""), text.size()));
  return !text.empty() && starts.find(text.front()) != std::string_view::npos &&
         !is_plain_number(text);
}

/// What a spreadsheet may take for a cell: the text, and what follows a separator in it. Calls
/// `add(part, is_formula)` with each part, its separator at its end.
template <class Add>
void each_cell(std::string_view text, const Add& add) {
  bool is_formula = looks_like_formula(text, "=+-@\t\r\n");
  for (;;) {
    const auto separator = text.find_first_of(";\t\r\n");
    if (separator == std::string_view::npos) return add(text, is_formula);
    add(text.substr(0, separator + 1), is_formula);
    text.remove_prefix(separator + 1);
    is_formula = looks_like_formula(text.substr(0, text.find_first_of(";\t\r\n")), "=+-@");
  }
}

}  // namespace

std::string csv_field(std::string_view text) {
  std::string plain;
  each_cell(text, [&](std::string_view part, bool is_formula) {
    if (is_formula) plain += '\'';
    plain += part;
  });
  if (plain.find_first_of(",;\"\t\r\n") == std::string::npos) return plain;
  std::string quoted = "\"";
  for (const char c : plain) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string unguarded(std::string_view cell) {
  std::string text;
  each_cell(cell, [&](std::string_view part, bool is_formula) {
    if (is_formula && part.starts_with('\'')) part.remove_prefix(1);
    text += part;
  });
  return text;
}

}  // namespace dripline
