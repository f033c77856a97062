#include "protocol/audit/escape.hpp"

#include <array>
#include <span>

#include "protocol/base/hex.hpp"

namespace dripline::audit {
namespace {

bool is_plain(char c) {
  return c >= ' ' && c < '\x7f' && c != '\\';
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string line;
  line.reserve(text.size());
  for (const char c : text) {
    if (is_plain(c)) {
      line += c;
    } else {
      line += "\\x" + hex_text(std::as_bytes(std::span(&c, 1)));
    }
  }
  return line;
}

std::optional<std::string> unescaped(std::string_view text) {
  constexpr std::size_t kEscape = 4;
  std::string plain;
  while (!text.empty()) {
    if (is_plain(text.front())) {
      plain += text.front();
      text.remove_prefix(1);
      continue;
    }
    std::array<std::byte, 1> byte{};
    if (!text.starts_with("\\x") || text.size() < kEscape || !parse_hex(text.substr(2, 2), byte)) {
      return std::nullopt;
    }
    const char c = static_cast<char>(byte.front());
    if (is_plain(c) || hex_text(byte) != text.substr(2, 2)) return std::nullopt;
    plain += c;
    text.remove_prefix(kEscape);
  }
  return plain;
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const auto tab = line.find('\t');
    fields.push_back(line.substr(0, tab));
    if (tab == std::string_view::npos) return fields;
    line.remove_prefix(tab + 1);
  }
}

}  // namespace dripline::audit
