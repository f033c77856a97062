#include "storage/postgresql/text_bytes.hpp"

#include <algorithm>

#include "protocol/base/utf8.hpp"

namespace dripline::storage::postgresql {
namespace {

// U+F700 to U+F7FF in UTF-8: EF, then 9C to 9F, then six bits.
constexpr unsigned char kLead = 0xEF, kSecond = 0x9C, kContinued = 0x80;
constexpr std::size_t kLength = 3;

unsigned char byte_at(std::string_view text, std::size_t at) {
  return static_cast<unsigned char>(text[at]);
}

bool is_substitute(std::string_view text) {
  return text.size() >= kLength && byte_at(text, 0) == kLead &&
         (byte_at(text, 1) & 0xFC) == kSecond;
}

bool is_plain(char c) {
  return c > '\0';  // ASCII without NUL
}

void append_substitute(std::string& stored, unsigned char byte) {
  stored += static_cast<char>(kLead);
  stored += static_cast<char>(kSecond | byte >> 6);
  stored += static_cast<char>(kContinued | (byte & 0x3F));
}

}  // namespace

std::string to_stored(std::string_view text) {
  if (std::ranges::all_of(text, is_plain)) return std::string(text);
  std::string stored;
  stored.reserve(text.size() + kLength);
  while (!text.empty()) {
    std::size_t length = text.front() == '\0' ? 0 : utf8_length(text);
    if (length == 0 || is_substitute(text)) {
      append_substitute(stored, byte_at(text, 0));
      length = 1;
    } else {
      stored += text.substr(0, length);
    }
    text.remove_prefix(length);
  }
  return stored;
}

std::string from_stored(std::string_view stored) {
  if (stored.find(static_cast<char>(kLead)) == std::string_view::npos) return std::string(stored);
  std::string text;
  text.reserve(stored.size());
  while (!stored.empty()) {
    if (is_substitute(stored)) {
      text += static_cast<char>((byte_at(stored, 1) & 0x03) << 6 | (byte_at(stored, 2) & 0x3F));
      stored.remove_prefix(kLength);
    } else {
      text += stored.front();
      stored.remove_prefix(1);
    }
  }
  return text;
}

}  // namespace dripline::storage::postgresql
