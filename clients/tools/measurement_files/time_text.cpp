#include <array>
#include <charconv>

#include "clients/tools/measurement_files/text_files.hpp"

namespace dripline::measurement_files {
namespace {

/// Exactly `digits` digits at the beginning, which are taken off.
std::optional<int> take_digits(std::string_view& text, std::size_t digits) {
  if (text.size() < digits) return std::nullopt;
  int value = 0;
  for (std::size_t i = 0; i < digits; ++i) {
    if (text[i] < '0' || text[i] > '9') return std::nullopt;
    value = value * 10 + (text[i] - '0');
  }
  text.remove_prefix(digits);
  return value;
}

bool take(std::string_view& text, std::string_view any) {
  if (text.empty() || any.find(text.front()) == std::string_view::npos) return false;
  text.remove_prefix(1);
  return true;
}

/// ".123456", any number of digits; those after the sixth are dropped.
std::chrono::microseconds take_fraction(std::string_view& text) {
  std::int64_t value = 0;
  std::int64_t unit = 100000;
  while (!text.empty() && text.front() >= '0' && text.front() <= '9') {
    value += unit * (text.front() - '0');
    unit /= 10;
    text.remove_prefix(1);
  }
  return std::chrono::microseconds(value);
}

}  // namespace

std::optional<UtcTime> parse_time(std::string_view text) {
  using namespace std::chrono;
  std::array<std::optional<int>, 6> part;
  constexpr std::array<std::size_t, 6> kDigits{4, 2, 2, 2, 2, 2};
  constexpr std::array<std::string_view, 6> kAfter{"-", "-", "T ", ":", ":", ""};
  for (std::size_t i = 0; i < part.size(); ++i) {
    part[i] = take_digits(text, kDigits[i]);
    if (!part[i] || (!kAfter[i].empty() && !take(text, kAfter[i]))) return std::nullopt;
  }
  const year_month_day date{year(*part[0]), month(static_cast<unsigned>(*part[1])),
                            day(static_cast<unsigned>(*part[2]))};
  if (!date.ok() || *part[3] > 23 || *part[4] > 59 || *part[5] > 60) return std::nullopt;
  microseconds fraction{0};
  if (take(text, ".,")) fraction = take_fraction(text);
  if (!text.empty() && text != "Z") return std::nullopt;
  return UtcTime(sys_days(date)) + hours(*part[3]) + minutes(*part[4]) + seconds(*part[5]) +
         fraction;
}

}  // namespace dripline::measurement_files
