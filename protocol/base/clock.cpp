#include "protocol/base/clock.hpp"

#include <fmt/chrono.h>
#include <ctime>
#include <optional>

namespace dripline {

UtcTime SystemClock::now() const {
  return std::chrono::time_point_cast<std::chrono::microseconds>(std::chrono::system_clock::now());
}

namespace {

constexpr UtcTime start_of(int year) {
  return std::chrono::sys_days{std::chrono::year{year} / 1 / 1};
}

/// Writes the last `digits` of a number that is not negative.
void put_digits(char* to, std::size_t digits, std::int64_t number) {
  while (digits > 0) {
    to[--digits] = static_cast<char>('0' + number % 10);
    number /= 10;
  }
}

/// Of a year with four digits: every status has several times, and a thousand machines write five
/// a second.
std::string usual_text(UtcTime time) {
  const auto day = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date(day);
  const std::int64_t micros = (time - day).count();
  const std::int64_t seconds = micros / 1'000'000;
  std::string text = "0000-00-00T00:00:00.000000Z";
  put_digits(&text[0], 4, int{date.year()});
  put_digits(&text[5], 2, unsigned{date.month()});
  put_digits(&text[8], 2, unsigned{date.day()});
  put_digits(&text[11], 2, seconds / 3600);
  put_digits(&text[14], 2, seconds / 60 % 60);
  put_digits(&text[17], 2, seconds % 60);
  put_digits(&text[20], 6, micros % 1'000'000);
  return text;
}

}  // namespace

std::string to_iso8601(UtcTime time) {
  if (time >= start_of(1000) && time < start_of(10000)) return usual_text(time);
  // Numbers, not durations: the time before the first whole second, in microseconds, would exceed
  // them, and so would times from outside in the system clock's nanoseconds.
  constexpr std::int64_t kMicros = 1'000'000;
  const std::int64_t count = time.time_since_epoch().count();
  const std::int64_t micros = (count % kMicros + kMicros) % kMicros;
  const auto seconds = static_cast<std::time_t>(count / kMicros - (count % kMicros < 0 ? 1 : 0));
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:06}Z", fmt::gmtime(seconds), micros);
}

namespace {

/// `count` digits at the beginning, which are taken off; nullopt: they are not there.
std::optional<int> take_digits(std::string_view& text, std::size_t count) {
  if (text.size() < count) return std::nullopt;
  int value = 0;
  for (const char c : text.substr(0, count)) {
    if (c < '0' || c > '9') return std::nullopt;
    value = value * 10 + (c - '0');
  }
  text.remove_prefix(count);
  return value;
}

bool take(std::string_view& text, char c) {
  if (!text.starts_with(c)) return false;
  text.remove_prefix(1);
  return true;
}

std::optional<std::chrono::sys_days> take_date(std::string_view& text) {
  const auto year = take_digits(text, 4);
  if (!year || !take(text, '-')) return std::nullopt;
  const auto month = take_digits(text, 2);
  if (!month || !take(text, '-')) return std::nullopt;
  const auto day = take_digits(text, 2);
  if (!day) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year{*year},
                                         std::chrono::month{static_cast<unsigned>(*month)},
                                         std::chrono::day{static_cast<unsigned>(*day)}};
  if (!date.ok()) return std::nullopt;
  return std::chrono::sys_days{date};
}

std::optional<std::chrono::microseconds> take_time(std::string_view& text) {
  const auto hour = take_digits(text, 2);
  if (!hour || *hour > 23 || !take(text, ':')) return std::nullopt;
  const auto minute = take_digits(text, 2);
  if (!minute || *minute > 59 || !take(text, ':')) return std::nullopt;
  const auto second = take_digits(text, 2);
  if (!second || *second > 59) return std::nullopt;
  std::chrono::microseconds time =
      std::chrono::hours(*hour) + std::chrono::minutes(*minute) + std::chrono::seconds(*second);
  if (!take(text, '.')) return time;
  int scale = 1'000'000;
  if (text.empty()) return std::nullopt;
  while (scale > 1) {
    const auto digit = take_digits(text, 1);
    if (!digit) break;
    scale /= 10;
    time += std::chrono::microseconds(*digit * scale);
  }
  return time;
}

}  // namespace

Result<UtcTime> parse_iso8601(std::string_view text) {
  std::string_view rest = text;
  const auto date = take_date(rest);
  if (date && rest.empty()) return UtcTime{*date};
  if (date && take(rest, 'T')) {
    const auto time = take_time(rest);
    if (time && rest == "Z") return UtcTime{*date} + *time;
  }
  return fail(Errc::Syntax, "time '{}' is not like 2026-11-21T07:40:06Z or 2026-11-21",
              text.substr(0, 40));
}

}  // namespace dripline
