#include "gateway/line/heads/scan_block.hpp"

#include "gateway/line/heads/scan_text.hpp"

namespace dripline::line {

ScannedBlock scan_block(std::string_view text) {
  ScannedBlock block;
  int depth = 0;
  bool is_comment = false;
  for (const char c : text) {
    if (is_comment) {
      is_comment = c != ')';
    } else if (c == '(') {
      is_comment = true;
    } else if (c == ';') {
      break;
    } else if (depth == 0 && is_letter(c)) {
      block.push_back({upper(c), {}, true});
    } else if (c != ' ' && c != '\t' && c != '\r' && !block.empty()) {
      if (c == '[') ++depth;
      if (c == ']') --depth;
      block.back().value += upper(c);
      block.back().is_number = block.back().is_number && is_of_number(c);
    }
  }
  return block;
}

}  // namespace dripline::line
