#include "protocol/base/one_line.hpp"

#include <fmt/format.h>
#include <iterator>

namespace dripline {

std::string one_line(std::string_view text) {
  std::string line;
  line.reserve(text.size());
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    constexpr unsigned char kBlank = 0x20;
    constexpr unsigned char kDelete = 0x7f;
    if (code >= kBlank && code != kDelete) {
      line += c;
    } else if (c == '\n') {
      line += "\\n";
    } else {
      line += fmt::format("\\x{:02x}", code);
    }
  }
  return line;
}

}  // namespace dripline
