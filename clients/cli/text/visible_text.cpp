#include "clients/cli/text/visible_text.hpp"

#include <fmt/format.h>
#include <iterator>
#include <utility>

namespace dripline::cli {

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
