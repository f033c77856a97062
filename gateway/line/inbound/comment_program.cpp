#include "gateway/line/inbound/comment_program.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace dripline::line {
namespace {

constexpr std::size_t kMaxComment = 60;
constexpr std::string_view kSigns = " .-+/=:,";

/// Capitals, digits and `.-+/=:,` only, at most 60 characters: what every control takes in a
/// comment.
std::string comment_text(std::string_view words) {
  std::string text;
  for (const char c : words.substr(0, kMaxComment)) {
    const bool is_small = c >= 'a' && c <= 'z';
    const bool is_plain =
        (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || kSigns.find(c) != kSigns.npos;
    if (is_small) {
      text += static_cast<char>(c - 'a' + 'A');
    } else {
      text += is_plain ? c : ' ';
    }
  }
  return text;
}

}  // namespace

std::vector<std::string> comment_lines(std::string_view words) {
  constexpr std::size_t kMaxLines = 4;
  std::vector<std::string> lines;
  while (!words.empty() && lines.size() < kMaxLines) {
    auto end = words.size() <= kMaxComment ? words.size() : words.rfind(' ', kMaxComment);
    if (end == std::string_view::npos || end == 0) end = kMaxComment;
    lines.emplace_back(words.substr(0, end));
    words.remove_prefix(end);
    words.remove_prefix(std::min(words.find_first_not_of(' '), words.size()));
  }
  return lines;
}

std::string comment_program(const std::string& name, std::span<const std::string> lines) {
  std::string text = fmt::format("%\n{}\n", name);
  for (const auto& line : lines) text += fmt::format("({})\n", comment_text(line));
  return text + "M30\n%\n";
}

}  // namespace dripline::line
