#include "clients/cli/text/value_text.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <iterator>
#include <optional>

#include <fmt/core.h>
#include <fmt/format.h>

#include "protocol/base/clock.hpp"

namespace dripline::cli {

namespace {

/// A time of day is part of it: a date alone stays as it is.
std::optional<UtcTime> parse_time(std::string_view text) {
  constexpr std::size_t kShortest = std::string_view("2026-11-21T07:40:06Z").size();
  if (text.size() < kShortest) return std::nullopt;
  const auto time = parse_iso8601(text);
  return time ? std::optional(*time) : std::nullopt;
}

std::tm local_parts(UtcTime time) {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(time).time_since_epoch().count();
  const auto whole = static_cast<std::time_t>(seconds);
  std::tm local{};
  ::localtime_r(&whole, &local);
  return local;
}

}  // namespace

std::string bytes_text(std::uint64_t bytes) {
  if (bytes < 1000) return fmt::format("{} B", bytes);
  constexpr std::string_view kUnits[] = {"kB", "MB", "GB", "TB"};
  double value = static_cast<double>(bytes) / 1000;
  std::size_t unit = 0;
  for (; value >= 999.95 && unit + 1 < std::size(kUnits); ++unit) value /= 1000;
  return fmt::format("{:.{}f} {}", value, unit >= 2 ? 2 : 1, kUnits[unit]);
}

std::string duration_text(double seconds) {
  const auto whole = static_cast<std::uint64_t>(std::clamp(seconds, 0.0, 3.6e9));
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string time_text(std::string_view iso8601) {
  const auto time = parse_time(iso8601);
  if (!time) return std::string(iso8601);
  const std::tm local = local_parts(*time);
  char text[32];
  const std::size_t size = std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", &local);
  return std::string(text, size);
}

std::string clock_text(std::string_view iso8601) {
  const auto time = parse_time(iso8601);
  if (!time) return std::string(iso8601);
  const std::tm local = local_parts(*time);
  const auto past_second = *time - std::chrono::floor<std::chrono::seconds>(*time);
  return fmt::format("{:02}:{:02}:{:02}.{:03}", local.tm_hour, local.tm_min, local.tm_sec,
                     past_second / std::chrono::milliseconds(1));
}

double seconds_between(std::string_view from, std::string_view to) {
  const auto first = parse_time(from), second = parse_time(to);
  if (!first || !second) return 0;
  return std::chrono::duration<double>(*second - *first).count();
}

std::string control_value_text(const std::optional<double>& value) {
  return value ? fmt::format("{:.10g}", *value) : "vacant";
}

std::string short_id(std::string_view id) {
  return std::string(id.substr(0, 8));
}

}  // namespace dripline::cli
