#include "gateway/app/restart/restart_argument.hpp"

#include <charconv>
#include <optional>

namespace dripline::gateway {
namespace {

/// All of `text` as a whole number.
std::optional<std::uint64_t> whole(std::string_view text) {
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  if (read.ec != std::errc{} || read.ptr != end) return std::nullopt;
  return value;
}

/// Takes a number of exactly `digits` digits and the character after it.
bool take(std::string_view& text, std::size_t digits, std::string_view after, unsigned& value) {
  if (text.size() < digits || text.find_first_not_of("0123456789") < digits) return false;
  const auto number = whole(text.substr(0, digits));
  if (!number) return false;
  value = static_cast<unsigned>(*number);
  text.remove_prefix(digits);
  if (!text.starts_with(after)) return false;
  text.remove_prefix(after.size());
  return true;
}

/// ".123456", or nothing.
std::optional<std::int64_t> take_microseconds(std::string_view& text) {
  if (!text.starts_with(".")) return 0;
  text.remove_prefix(1);
  const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
  if (digits == 0 || digits > 6) return std::nullopt;
  auto value = static_cast<std::int64_t>(*whole(text.substr(0, digits)));
  for (std::size_t i = digits; i < 6; ++i) value *= 10;
  text.remove_prefix(digits);
  return value;
}

}  // namespace

Result<UtcTime> parse_utc_time(std::string_view text) {
  using namespace std::chrono;
  std::string_view rest = text;
  unsigned year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0;
  const bool has_fields = take(rest, 4, "-", year) && take(rest, 2, "-", month) &&
                          take(rest, 2, "T", day) && take(rest, 2, ":", hour) &&
                          take(rest, 2, ":", minute) && take(rest, 2, "", second);
  const auto micros = has_fields ? take_microseconds(rest) : std::nullopt;
  const year_month_day date(std::chrono::year(static_cast<int>(year)), std::chrono::month(month),
                            std::chrono::day(day));
  if (!micros || rest != "Z" || !date.ok() || hour > 23 || minute > 59 || second > 59)
    return fail(Errc::Syntax, "'{}' is no time: expected 2026-11-23T15:04:05Z", text);
  return UtcTime(sys_days(date)) + hours(hour) + minutes(minute) + seconds(second) +
         microseconds(*micros);
}

Result<RestartPlace> parse_restart_place(std::string_view text) {
  using Kind = RestartPlace::Kind;
  RestartPlace place;
  place.text = text;
  if (text == "executed") return place;
  const auto number_after = [&](std::string_view prefix, Kind kind) {
    const auto number = text.starts_with(prefix) ? whole(text.substr(prefix.size())) : std::nullopt;
    if (!number) return false;
    place.kind = kind;
    place.number = *number;
    return true;
  };
  const bool has_number = number_after("block=", Kind::Block) || number_after("L", Kind::Line) ||
                          number_after("N", Kind::Sequence) || number_after("T", Kind::Tool);
  if (has_number) return place;
  constexpr std::string_view kTime = "time=";
  if (text.starts_with(kTime)) {
    const auto time = parse_utc_time(text.substr(kTime.size()));
    if (!time) return fail(time.error());
    place.kind = Kind::Time;
    place.time = *time;
    return place;
  }
  return fail(Errc::Syntax,
              "'{}' names no place for a restart: executed, block=1234, L7 (line), N120, T3 (tool) "
              "or time=2026-11-23T15:04:05Z",
              text);
}

}  // namespace dripline::gateway
