#include "server/library/program_title.hpp"

#include <algorithm>
#include <optional>

#include "protocol/base/lines.hpp"
#include "protocol/base/utf8.hpp"

namespace dripline::library {
namespace {

constexpr std::string_view kBlanks = " \t\r";
constexpr std::string_view kBeginOfTnc = "BEGIN PGM ";

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Text without the first `O123` or `:123`.
std::string_view after_number(std::string_view block) {
  constexpr std::string_view kLetters = "Oo:";
  if (block.size() < 2 || kLetters.find(block[0]) == kLetters.npos || !is_digit(block[1])) {
    return block;
  }
  const auto end = std::find_if_not(block.begin() + 1, block.end(), is_digit);
  return trimmed(block.substr(static_cast<std::size_t>(end - block.begin())), kBlanks);
}

/// `( ... )`, or `; ...` to the end of the line.
std::optional<std::string_view> comment_in(std::string_view block) {
  const auto begin = block.find_first_of("(;");
  if (begin == std::string_view::npos) return std::nullopt;
  const auto end = block[begin] == '(' ? block.find(')', begin) : std::string_view::npos;
  const auto text =
      trimmed(block.substr(begin + 1, end == block.npos ? end : end - begin - 1), kBlanks);
  if (text.empty()) return std::nullopt;
  return text;
}

/// Whole characters, without what a terminal or a listing would act on.
std::string shown(std::string_view text) {
  std::string title(text.substr(0, kMaxTitle));
  const auto is_continuation = [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) == 0x80;
  };
  if (text.size() > kMaxTitle && is_continuation(text[kMaxTitle])) {
    while (!title.empty() && is_continuation(title.back())) title.pop_back();
    if (!title.empty()) title.pop_back();
  }
  return one_line(title);
}

}  // namespace

std::string program_title(std::string_view head) {
  std::optional<std::string_view> front;  ///< comment alone in front of the first block
  std::optional<std::string_view> first;  ///< block, without its number
  while (!head.empty()) {
    const auto end = std::min(head.find('\n'), head.size());
    const auto line = trimmed(head.substr(0, end), kBlanks);
    head.remove_prefix(std::min(end + 1, head.size()));
    if (line.empty() || line == "%") continue;
    if (const auto pgm = line.find(kBeginOfTnc); pgm != std::string_view::npos) {
      const auto name = line.substr(pgm + kBeginOfTnc.size());
      return shown(name.substr(0, name.find(' ')));
    }
    const auto comment = comment_in(line);
    const bool is_alone = line.front() == '(' || line.front() == ';';
    if (first && !(is_alone && comment)) break;
    if (first) return shown(front.value_or(*comment));
    if (is_alone) {
      if (!front) front = comment;
      continue;
    }
    first = after_number(line);
    const bool has_number = first->size() != line.size();
    if (comment && (has_number || !front)) return shown(*comment);
    if (!has_number && front) break;
  }
  if (front) return shown(*front);
  return shown(first.value_or(std::string_view()));
}

std::string ProgramTitles::of(const Digest& content) {
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = known_.find(content); found != known_.end()) return found->second;
  }
  const auto bytes = store_.read_content(content, 0, kTitleHead);
  if (!bytes) return {};
  std::string title = program_title({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
  const std::lock_guard lock(mutex_);
  if (known_.emplace(content, title).second) order_.push_back(content);
  if (order_.size() > kMaxKnown) {
    known_.erase(order_.front());
    order_.pop_front();
  }
  return title;
}

}  // namespace dripline::library
