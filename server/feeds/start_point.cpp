#include "server/feeds/start_point.hpp"

#include <charconv>

namespace dripline::feeds {

Result<StartPoint> parse_start_point(std::string_view text) {
  char letter = 'N';
  std::string_view digits = text;
  if (!digits.empty() && (digits[0] < '0' || digits[0] > '9')) {
    letter = static_cast<char>(digits[0] & ~0x20);
    digits.remove_prefix(1);
  }
  std::uint64_t value = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool is_whole = read.ec == std::errc{} && read.ptr == digits.data() + digits.size();
  StartPoint point;
  if (is_whole && letter == 'N') {
    point.sequence = value;
  } else if (is_whole && letter == 'L') {
    point.line = value;
  } else if (is_whole && letter == 'B') {
    point.byte = value;
  } else {
    return fail(Errc::Syntax, "'{}' names no block: N120, L7 (line) or B4096 (byte)", text);
  }
  return point;
}

}  // namespace dripline::feeds
