#pragma once

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

namespace dripline::test {

/// Reads a picture as our SVG canvas writes it. Empty, or what is wrong with it: a tag that is not
/// closed, a coordinate that is no finite number or far out, a text with an infinite number or too
/// long to be read.
class SvgCheck {
 public:
  static std::string fault_of(std::string_view svg) { return SvgCheck(svg).run(); }

 private:
  explicit SvgCheck(std::string_view svg) : left_(svg) {}

  std::string run() {
    std::vector<std::string> open;
    while (!left_.empty()) {
      const auto text = left_.substr(0, left_.find('<'));
      if (!open.empty() && open.back() == "text") check_text(text);
      left_.remove_prefix(text.size());
      if (left_.empty()) break;
      const auto end = left_.find('>');
      if (end == std::string_view::npos) return "a tag without end";
      const std::string tag(left_.substr(1, end - 1));
      left_.remove_prefix(end + 1);
      const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
      if (tag.front() == '/') {
        if (open.empty() || "/" + open.back() != tag) return "unexpected <" + tag + ">";
        open.pop_back();
        continue;
      }
      check_attributes(tag);
      if (tag.back() != '/') open.push_back(name);
    }
    if (!open.empty()) return open.back() + " is not closed";
    return fault_;
  }

  void check_text(std::string_view text) {
    if (text.size() > 400) fault_ = "a text of " + std::to_string(text.size()) + " characters";
    std::string word;
    for (const char c : std::string(text) + " ") {
      if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
        word += c;
        continue;
      }
      if (word == "inf" || word == "nan") fault_ = "text '" + std::string(text) + "'";
      word.clear();
    }
  }

  void check_attributes(std::string_view tag) {
    constexpr std::string_view kNumbers[]{" x=\"", " y=\"",     " cx=\"",     " cy=\"",
                                          " r=\"", " width=\"", " height=\"", " points=\""};
    for (const auto name : kNumbers) {
      const auto at = tag.find(name);
      if (at == std::string_view::npos) continue;
      auto value = tag.substr(at + name.size());
      check_numbers(std::string(value.substr(0, value.find('"'))));
    }
  }

  void check_numbers(const std::string& numbers) {
    const char* at = numbers.c_str();
    while (*at != '\0') {
      char* end = nullptr;
      const double value = std::strtod(at, &end);
      constexpr double kFar = 1e6;  // pictures have up to 8192 units
      if (end == at || !std::isfinite(value) || std::abs(value) > kFar) {
        fault_ = "coordinates " + numbers.substr(0, 80);
        return;
      }
      at = end;
      if (*at == ',' || *at == ' ') ++at;
    }
  }

  std::string_view left_;
  std::string fault_;
};

}  // namespace dripline::test
