#include "clients/tools/post/carried_comments.hpp"

#include <algorithm>
#include <array>

#include "clients/tools/comparison/normal_form.hpp"

namespace dripline::post {
namespace {

constexpr std::array<std::string_view, 8> kActive{"MSG",   "DEBUG", "PRINT", "LOG",
                                                  "ABORT", "PROBE", "PY",    "STOP"};

std::string printable(std::string_view comment) {
  std::string text;
  for (const char c : comment.substr(0, CarriedComments::kMaxLength)) {
    const bool is_parenthesis = c == '(' || c == ')';
    const bool is_printable = c >= ' ' && c <= '~';
    text += is_parenthesis || c == '\t' || c == '\r' ? ' ' : is_printable ? c : '?';
  }
  const auto is_text = [](char c) { return c != ' '; };
  text.erase(std::find_if(text.rbegin(), text.rend(), is_text).base(), text.end());
  text.erase(text.begin(), std::find_if(text.begin(), text.end(), is_text));
  return text;
}

}  // namespace

bool is_active_comment(std::string_view comment) {
  std::string compact;
  for (const char c : comment.substr(0, 16)) {
    if (c > ' ') compact += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return std::ranges::any_of(kActive,
                             [&](std::string_view mark) { return compact.starts_with(mark); });
}

CarriedComments::CarriedComments(std::string_view control, std::string_view text) : text_(text) {
  const auto& rules = comparison::lexical_rules(control);
  has_parentheses_ = rules.has_parentheses;
  has_semicolon_ = rules.has_semicolon;
}

void CarriedComments::take_up_to(std::uint64_t offset, std::vector<std::string>& comments) {
  if (!has_parentheses_ && !has_semicolon_) return;
  const std::size_t end =
      std::min(text_.find('\n', std::min<std::size_t>(offset, text_.size())), text_.size());
  const std::string_view part = text_.substr(0, end);  // nothing after it is searched
  while (at_ < end) {
    at_ = part.find_first_of(has_semicolon_ ? "(;" : "(", at_);
    if (at_ >= end) {
      at_ = end;
      return;
    }
    const std::size_t line_end = std::min(part.find('\n', at_), end);
    const std::size_t close =
        part[at_] == ';' ? line_end : std::min(part.substr(0, line_end).find(')', at_), line_end);
    const std::string_view comment = text_.substr(at_ + 1, close - at_ - 1);
    std::string text = printable(comment);
    if (!text.empty() && !is_active_comment(comment)) comments.push_back(std::move(text));
    at_ = close;
  }
}

}  // namespace dripline::post
