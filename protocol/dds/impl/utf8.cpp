#include "protocol/dds/impl/utf8.hpp"

#include <fmt/core.h>

#include "protocol/base/utf8.hpp"

namespace dripline::dds {
namespace {

constexpr std::string_view kEllipsis = "…";

/// Length of the first character of `text` in bytes; 0 when it cannot be sent.
std::size_t sendable_length(std::string_view text) {
  return text[0] == '\0' ? 0 : utf8_length(text);
}

}  // namespace

bool is_sendable_text(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = sendable_length(text);
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
    const std::size_t length = sendable_length(text);
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
