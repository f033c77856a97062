#include "protocol/wire/setting_value.hpp"

#include <fmt/ranges.h>
#include <array>
#include <charconv>

namespace dripline::wire {
namespace {

constexpr std::array<std::string_view, 32> kControlNames{
    "NUL", "SOH", "STX", "ETX", "EOT", "ENQ", "ACK", "BEL", "BS",  "HT",  "LF",
    "VT",  "FF",  "CR",  "SO",  "SI",  "DLE", "DC1", "DC2", "DC3", "DC4", "NAK",
    "SYN", "ETB", "CAN", "EM",  "SUB", "ESC", "FS",  "GS",  "RS",  "US"};
constexpr char kDelete = 0x7f;

tl::unexpected<Error> outside(std::string_view key, std::string_view value, SettingRange range) {
  return fail(Errc::LimitExceeded, "{} {} is outside {} to {}", key, value, range.least,
              range.most);
}

std::optional<char> named_character(std::string_view value) {
  for (std::size_t i = 0; i < kControlNames.size(); ++i) {
    if (kControlNames[i] == value) return static_cast<char>(i);
  }
  if (value == "DEL") return kDelete;
  return std::nullopt;
}

}  // namespace

Result<std::uint64_t> parse_number(std::string_view key, std::string_view value,
                                   SettingRange range) {
  std::uint64_t number = 0;
  const char* const end = value.data() + value.size();
  const auto [rest, error] = std::from_chars(value.data(), end, number);
  if (rest != end || value.empty() || error == std::errc::invalid_argument) {
    return fail(Errc::Syntax, "{} '{}' is not a whole number", key, value);
  }
  if (error != std::errc{} || number < range.least || number > range.most) {
    return outside(key, value, range);
  }
  return number;
}

Result<double> parse_rate(std::string_view key, std::string_view value, SettingRange range) {
  double number = 0;
  const char* const end = value.data() + value.size();
  const bool begins_well = !value.empty() && value.front() >= '0' && value.front() <= '9';
  const auto [rest, error] = std::from_chars(value.data(), end, number, std::chars_format::fixed);
  if (!begins_well || rest != end || error == std::errc::invalid_argument) {
    return fail(Errc::Syntax, "{} '{}' is not a number", key, value);
  }
  if (error != std::errc{} || number < static_cast<double>(range.least) ||
      number > static_cast<double>(range.most)) {
    return outside(key, value, range);
  }
  return number;
}

Result<bool> parse_flag(std::string_view key, std::string_view value) {
  if (value == "yes" || value == "true") return true;
  if (value == "no" || value == "false") return false;
  return fail(Errc::Syntax, "{} '{}' is neither yes nor no", key, value);
}

Result<char> parse_character(std::string_view key, std::string_view value) {
  if (value.size() == 1 && value[0] > ' ' && value[0] < kDelete) return value[0];
  if (const auto named = named_character(value)) return *named;
  if (value.size() > 2 && value.size() <= 4 && value.substr(0, 2) == "0x") {
    unsigned code = 0;
    const char* const end = value.data() + value.size();
    const auto [rest, error] = std::from_chars(value.data() + 2, end, code, 16);
    if (rest == end && error == std::errc{} && code <= 0x7f) return static_cast<char>(code);
  }
  return fail(Errc::Syntax,
              "{} '{}' is not a character: one itself (%), a name (ETX), or 0x00 to 0x7f", key,
              value);
}

std::string character_text(char character) {
  if (character > ' ' && character < kDelete) return std::string(1, character);
  if (character == kDelete) return "DEL";
  const auto code = static_cast<unsigned char>(character);
  return code < kControlNames.size() ? std::string(kControlNames[code])
                                     : fmt::format("0x{:02x}", code);
}

Result<std::size_t> parse_word(std::string_view key, std::string_view value,
                               std::span<const std::string_view> words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == value) return i;
  }
  return fail(Errc::Syntax, "{} '{}' is none of {}", key, value, fmt::join(words, ", "));
}

}  // namespace dripline::wire
