#include "clients/tools/measurement_files/source.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "protocol/base/utf8.hpp"

namespace dripline::measurement_files {
namespace {

constexpr unsigned kMaxDecimals = 17;

/// Windows-1252 from 0x80 to 0x9F; 0: not used.
constexpr std::array<char32_t, 32> kUpper{
    0x20AC, 0,      0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0,      0x017D, 0,      0,      0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0,      0x017E, 0x0178};
constexpr char32_t kUnknown = 0xFFFD;

/// Takes one character off; damaged bytes give kUnknown, each by itself.
char32_t take_character(std::string_view& text) {
  const std::size_t length = utf8_length(text);
  const std::string_view bytes = text.substr(0, std::max<std::size_t>(1, length));
  text.remove_prefix(bytes.size());
  if (length == 0) return kUnknown;
  const auto lead = static_cast<unsigned char>(bytes.front());
  char32_t code = length == 1 ? lead : lead & (0xFFU >> (length + 1));
  for (const char next : bytes.substr(1))
    code = (code << 6U) | (static_cast<unsigned char>(next) & 0x3FU);
  return code;
}

void append_utf8(std::string& text, char32_t code) {
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xC0U | (code >> 6U));
    text += static_cast<char>(0x80U | (code & 0x3FU));
  } else {
    text += static_cast<char>(0xE0U | (code >> 12U));
    text += static_cast<char>(0x80U | ((code >> 6U) & 0x3FU));
    text += static_cast<char>(0x80U | (code & 0x3FU));
  }
}

}  // namespace

std::string decimal_text(double value, unsigned decimals) {
  for (unsigned tried = decimals; tried <= kMaxDecimals; ++tried) {
    std::string text = fmt::format("{:.{}f}", value, tried);
    double again = 0;
    std::from_chars(text.data(), text.data() + text.size(), again);
    if (again == value) return text;
  }
  // Seventeen digits from the first one that is not 0.
  const double leading = value == 0 ? 0 : std::max(0.0, -std::floor(std::log10(std::abs(value))));
  return fmt::format("{:.{}f}", value, kMaxDecimals + static_cast<unsigned>(leading));
}

std::optional<double> parse_finite(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

std::string_view take_until(std::string_view& text, char end) {
  const auto at = text.find(end);
  const std::string_view piece = text.substr(0, at);
  text = at == std::string_view::npos ? std::string_view() : text.substr(at + 1);
  return piece;
}

std::string one_line(std::string_view text) {
  std::string line(text);
  std::ranges::replace_if(
      line, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, ' ');
  return line;
}

namespace {

/// nullopt: the code page does not have it.
std::optional<char> windows_1252(char32_t code) {
  if (code < 0x80 || (code >= 0xA0 && code <= 0xFF)) return static_cast<char>(code);
  const auto upper = std::ranges::find(kUpper, code);
  if (upper == kUpper.end()) return std::nullopt;
  return static_cast<char>(0x80 + (upper - kUpper.begin()));
}

}  // namespace

std::string to_windows_1252(std::string_view utf8) {
  std::string bytes;
  bytes.reserve(utf8.size());
  while (!utf8.empty()) bytes += windows_1252(take_character(utf8)).value_or('?');
  return bytes;
}

std::size_t count_outside_windows_1252(std::string_view utf8) {
  std::size_t count = 0;
  while (!utf8.empty()) count += windows_1252(take_character(utf8)) ? 0 : 1;
  return count;
}

std::string from_windows_1252(std::string_view bytes) {
  std::string text;
  text.reserve(bytes.size());
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_upper = byte >= 0x80 && byte < 0xA0;
    const char32_t code = is_upper ? kUpper[byte - 0x80U] : byte;
    append_utf8(text, is_upper && code == 0 ? kUnknown : code);
  }
  return text;
}

bool is_same_part(const measurement::Measurement& a, const measurement::Measurement& b) {
  return a.machine == b.machine && a.run == b.run && a.part_id == b.part_id && a.part == b.part &&
         a.serial == b.serial && a.program == b.program;
}

Result<void> each_part(
    MeasurementSource& source,
    const std::function<Result<void>(const std::vector<measurement::Measurement>&)>& visit) {
  std::vector<measurement::Measurement> part;
  auto done = source.each([&](const measurement::Measurement& m) -> Result<void> {
    if (!part.empty() && !is_same_part(part.front(), m)) {
      if (auto visited = visit(part); !visited) return visited;
      part.clear();
    }
    part.push_back(m);
    return {};
  });
  return done && !part.empty() ? visit(part) : done;
}

}  // namespace dripline::measurement_files
