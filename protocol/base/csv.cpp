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

/// Apostrophes before it do not matter, so that those of a text itself come back.
bool looks_like_formula(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of('\''), text.size()));
  constexpr std::string_view kStarts = "=+-@\t\r\n";
  return !text.empty() && kStarts.find(text.front()) != std::string_view::npos &&
         !is_plain_number(text);
}

}  // namespace

std::string csv_field(std::string_view text) {
  const bool is_guarded = looks_like_formula(text);
  std::string plain = is_guarded ? "'" : "";
  plain += text;
  if (plain.find_first_of(",;\"\t\r\n") == std::string::npos) return plain;
  std::string quoted = "\"";
  for (const char c : plain) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string unguarded(std::string_view cell) {
  if (cell.starts_with('\'') && looks_like_formula(cell)) cell.remove_prefix(1);
  return std::string(cell);
}

}  // namespace dripline
