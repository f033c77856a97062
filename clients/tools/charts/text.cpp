#include "clients/tools/charts/text.hpp"

#include "protocol/base/markup.hpp"
#include "protocol/base/utf8.hpp"

namespace dripline::charts {

std::string clean_text(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const char first = text.front();
    const bool is_control =
        static_cast<unsigned char>(first) < 0x20 && first != '\t' && first != '\n' && first != '\r';
    if (length == 0 || is_control) {
      result += "\xEF\xBF\xBD";
    } else {
      result.append(text.substr(0, length));
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return result;
}

std::string xml_text(std::string_view text) {
  return escape_markup(clean_text(text));
}

}  // namespace dripline::charts
