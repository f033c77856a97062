#include "protocol/dds/impl/utf8.hpp"

#include <fmt/core.h>

namespace dripline::dds {
namespace {

constexpr std::string_view kEllipsis = "…";

/// Length of the well-formed character at the start of `text`, 0 when there is none.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first == 0) return 0;
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  const unsigned char second = byte(1);
  if (first == 0xE0 && second < 0xA0) return 0;  // overlong
  if (first == 0xED && second > 0x9F) return 0;  // surrogates
  if (first == 0xF0 && second < 0x90) return 0;  // overlong
  if (first == 0xF4 && second > 0x8F) return 0;  // beyond U+10FFFF
  return length;
}

}  // namespace

bool is_sendable_text(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string make_sendable(std::string_view text, std::size_t limit) {
  if (text.size() <= limit && is_sendable_text(text)) return std::string(text);
  std::string result;
  std::size_t fits = 0;  // the longest whole prefix that leaves room for the ellipsis
  while (!text.empty() && result.size() <= limit) {
    if (result.size() + kEllipsis.size() <= limit) fits = result.size();
    const std::size_t length = character_length(text);
    if (length > 0) {
      result += text.substr(0, length);
    } else {
      result += fmt::format("\\x{:02X}", static_cast<unsigned char>(text[0]));
    }
    text.remove_prefix(length > 0 ? length : 1);
  }
  if (result.size() <= limit) return result;
  result.resize(fits);
  result += kEllipsis;
  return result;
}

}  // namespace dripline::dds
