#include "clients/tools/conversational/events.hpp"

#include <fmt/format.h>
#include <charconv>
#include <cmath>

#include "protocol/base/decimal.hpp"
#include "protocol/base/lines.hpp"

namespace dripline::conversational {
namespace {

constexpr std::size_t kMaxCharacters = 20;

/// Digits with one point or none; no sign, no exponent.
std::optional<double> unsigned_number(std::string_view text) {
  if (text.empty() || text.size() > kMaxCharacters) return std::nullopt;
  bool has_digit = false, has_point = false;
  for (const char c : text) {
    if (c == '.' ? has_point : c < '0' || c > '9') return std::nullopt;
    (c == '.' ? has_point : has_digit) = true;
  }
  if (!has_digit) return std::nullopt;
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  return value;
}

bool is_whole(std::string_view text) {
  constexpr std::size_t kMaxDigits = 9;
  return text.size() <= kMaxDigits && text.find('.') == std::string_view::npos;
}

}  // namespace

Result<TypedNumber> parse_entry(std::string_view typed) {
  const auto wrong = [&] {
    return fail(Errc::Syntax, "\"{}\" is not a number such as 1.25 or 5/16", typed.substr(0, 40));
  };
  std::string_view text = trimmed(typed, " ");
  const double sign = text.starts_with('-') ? -1 : 1;
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  const auto stroke = text.find('/');
  if (stroke == std::string_view::npos) {
    const auto value = unsigned_number(text);
    if (!value) return wrong();
    return TypedNumber{sign * *value, false};
  }
  const auto above = text.substr(0, stroke), below = text.substr(stroke + 1);
  const auto numerator = unsigned_number(above), denominator = unsigned_number(below);
  if (!numerator || !denominator || !is_whole(above) || !is_whole(below)) return wrong();
  if (*denominator == 0) return fail(Errc::Syntax, "\"{}\" divides by zero", typed);
  return TypedNumber{sign * *numerator / *denominator, true};
}

std::string number_text(double value) {
  std::string text = decimal_text(value, 6);
  const std::size_t first = text.front() == '-' ? 1 : 0;
  if (text.size() > first + 1 && text[first] == '0') text.erase(first, 1);
  return text;
}

}  // namespace dripline::conversational
