#include "clients/tools/offline/number_text.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "protocol/base/utf8.hpp"

namespace dripline::interpreter {
namespace {

constexpr std::uint64_t kMillion = 1'000'000;
/// Below it, the value in millionths is exact enough for a double to hold its last digit.
constexpr double kFastLimit = 1e9;

template <class Whole>
void append_whole(std::string& out, Whole value) {
  std::array<char, 24> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  out.append(digits.data(), end);
}

/// The decimals of `millionths` below 10^6, without trailing zeros.
void append_decimals(std::string& out, std::uint64_t millionths) {
  std::array<char, 7> text{'.', '0', '0', '0', '0', '0', '0'};
  std::size_t used = 1;
  for (std::size_t at = 6; at >= 1; --at) {
    const auto digit = static_cast<char>(millionths % 10);
    millionths /= 10;
    text[at] = static_cast<char>('0' + digit);
    if (digit != 0 && used == 1) used = at + 1;
  }
  out.append(text.data(), used);
}

void append_large(std::string& out, double value) {
  std::string text = fmt::format("{:.6f}", value);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  out += text;
}

void append_escaped(std::string& out, char c) {
  switch (c) {
    case '"':
      out += "\\\"";
      return;
    case '\\':
      out += "\\\\";
      return;
    case '\n':
      out += "\\n";
      return;
    case '\r':
      out += "\\r";
      return;
    case '\t':
      out += "\\t";
      return;
    default:
      break;
  }
  if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
    out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
  } else {
    out += c;
  }
}

}  // namespace

void append_number(std::string& out, double value) {
  if (!std::isfinite(value)) {
    out += "null";
    return;
  }
  const double size = std::fabs(value);
  if (size >= kFastLimit) return append_large(out, value);
  const auto scaled =
      static_cast<std::uint64_t>(std::llround(size * static_cast<double>(kMillion)));
  if (scaled == 0) {
    out += '0';
    return;
  }
  if (value < 0) out += '-';
  append_whole(out, scaled / kMillion);
  if (const std::uint64_t decimals = scaled % kMillion) append_decimals(out, decimals);
}

void append_integer(std::string& out, std::int64_t value) {
  append_whole(out, value);
}
void append_integer(std::string& out, std::uint64_t value) {
  append_whole(out, value);
}

void append_json_string(std::string& out, std::string_view text) {
  out += '"';
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) {
      out += "\xEF\xBF\xBD";
      text.remove_prefix(1);
      continue;
    }
    if (length == 1) {
      append_escaped(out, text[0]);
    } else {
      out += text.substr(0, length);
    }
    text.remove_prefix(length);
  }
  out += '"';
}

}  // namespace dripline::interpreter
