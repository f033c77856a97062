#include "clients/cli/text/value_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <ctime>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/core.h>
#include <fmt/format.h>

namespace dripline::cli {

namespace {

std::optional<int> number_at(std::string_view text, std::size_t offset, std::size_t size) {
  int value = 0;
  const char* first = text.data() + offset;
  const auto result = std::from_chars(first, first + size, value);
  if (result.ec != std::errc() || result.ptr != first + size) return std::nullopt;
  return value;
}

struct UtcSeconds {
  std::time_t whole = 0;
  double fraction = 0;
};

/// YYYY-MM-DDTHH:MM:SS[.ffffff]Z
std::optional<UtcSeconds> parse_time(std::string_view text) {
  if (text.size() < 20 || text[4] != '-' || text[10] != 'T' || text.back() != 'Z') return {};
  const auto year = number_at(text, 0, 4), month = number_at(text, 5, 2),
             day = number_at(text, 8, 2);
  const auto hour = number_at(text, 11, 2), minute = number_at(text, 14, 2);
  const auto second = number_at(text, 17, 2);
  if (!year || !month || !day || !hour || !minute || !second) return {};
  std::tm parts{};
  parts.tm_year = *year - 1900;
  parts.tm_mon = *month - 1;
  parts.tm_mday = *day;
  parts.tm_hour = *hour;
  parts.tm_min = *minute;
  parts.tm_sec = *second;
  UtcSeconds time{::timegm(&parts), 0};
  if (text[19] == '.') {
    std::from_chars(text.data() + 19, text.data() + text.size() - 1, time.fraction,
                    std::chars_format::fixed);
  }
  return time;
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
  std::tm local{};
  ::localtime_r(&time->whole, &local);
  char text[32];
  const std::size_t size = std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", &local);
  return std::string(text, size);
}

std::string clock_text(std::string_view iso8601) {
  const auto time = parse_time(iso8601);
  if (!time) return std::string(iso8601);
  std::tm local{};
  ::localtime_r(&time->whole, &local);
  const int milliseconds = static_cast<int>(time->fraction * 1000 + 1e-6);
  return fmt::format("{:02}:{:02}:{:02}.{:03}", local.tm_hour, local.tm_min, local.tm_sec,
                     milliseconds);
}

double seconds_between(std::string_view from, std::string_view to) {
  const auto first = parse_time(from), second = parse_time(to);
  if (!first || !second) return 0;
  return static_cast<double>(second->whole - first->whole) + second->fraction - first->fraction;
}

std::string short_id(std::string_view id) {
  return std::string(id.substr(0, 8));
}

std::string_view VisibleText::take(std::string_view piece) {
  constexpr unsigned char kLead = 0xc2;  // of U+0080 to U+00BF in UTF-8
  text_.clear();
  const auto escape = [&](unsigned char c) { text_ += fmt::format("\\x{:02x}", c); };
  for (const char c : piece) {
    const auto byte = static_cast<unsigned char>(c);
    const bool ends_two = std::exchange(is_after_c2_, false);
    if (ends_two && byte >= 0x80 && byte < 0xa0) {
      escape(byte);
      continue;
    }
    if (ends_two) text_ += static_cast<char>(kLead);
    is_after_c2_ = byte == kLead;
    if (is_after_c2_) continue;
    const bool is_control = (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7f;
    if (is_control) {
      escape(byte);
    } else {
      text_ += c;
    }
  }
  return text_;
}

}  // namespace dripline::cli
