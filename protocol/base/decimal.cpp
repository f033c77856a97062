#include "protocol/base/decimal.hpp"

#include <fmt/format.h>
#include <array>

namespace dripline {
namespace {

constexpr int kMaxDigits = 18;

constexpr std::array<double, kMaxDigits + 1> kPowersOfTen{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,
                                                          1e7,  1e8,  1e9,  1e10, 1e11, 1e12, 1e13,
                                                          1e14, 1e15, 1e16, 1e17, 1e18};

}  // namespace

double Decimal::value() const {
  if (negative_zero) return -0.0;
  return static_cast<double>(digits) / kPowersOfTen[scale];
}

std::string Decimal::text() const {
  const bool negative = digits < 0 || negative_zero;
  std::string all = fmt::format("{:0{}}", digits < 0 ? -digits : digits, scale + 1);
  const std::size_t point = all.size() - scale;
  std::string text = (negative ? "-" : "") + all.substr(0, point);
  if (has_point) text += "." + all.substr(point);
  return text;
}

Result<Decimal> parse_decimal(std::string_view text) {
  std::size_t at = 0;
  const bool negative = !text.empty() && text[0] == '-';
  if (!text.empty() && (text[0] == '-' || text[0] == '+')) ++at;
  Decimal number;
  int written = 0;
  int significant = 0;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '.' && !number.has_point) {
      number.has_point = true;
      continue;
    }
    if (c < '0' || c > '9') return fail(Errc::Syntax, "'{}' is not a decimal number", text);
    ++written;
    if (significant > 0 || c != '0') ++significant;
    if (number.has_point) ++number.scale;
    if (significant > kMaxDigits || number.scale > kMaxDigits) {
      return fail(Errc::LimitExceeded, "'{}' has more than {} digits", text, kMaxDigits);
    }
    number.digits = number.digits * 10 + (c - '0');
  }
  if (written == 0) return fail(Errc::Syntax, "'{}' is not a decimal number", text);
  number.negative_zero = negative && number.digits == 0;
  if (negative) number.digits = -number.digits;
  return number;
}

std::string decimal_text(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (decimals > 0) text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

}  // namespace dripline
