#include "gateway/line/heads/tool_finder.hpp"

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <utility>

#include "gateway/interpreter/registry.hpp"
#include "gateway/line/heads/scan_text.hpp"

namespace dripline::line {

namespace {

using Form = interpreter::TextForm::Kind;

Form form_of(std::string_view control) {
  const auto dialect = interpreter::find_dialect(control);
  return dialect ? (*dialect)->text.kind : Form::Words;
}

std::optional<std::uint64_t> whole(std::string_view text) {
  std::uint64_t number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_whole = read.ec == std::errc{} && read.ptr == text.data() + text.size();
  return is_whole ? std::optional(number) : std::nullopt;
}

/// In tenths.
bool has_function(const ScannedBlock& block, std::initializer_list<int> codes) {
  return std::ranges::any_of(block, [&](const ScannedWord& word) {
    return word.letter == 'M' && word.is_number &&
           std::ranges::find(codes, tenths(word.value)) != codes.end();
  });
}

constexpr auto kEnds = {20, 300, 990};
constexpr auto kChanges = {60};

}  // namespace

ToolFinder::ToolFinder(std::string_view control, std::uint64_t tool)
    : tool_(tool),
      form_(form_of(control)),
      is_turret_(control == "fanuc-t"),
      has_offset_in_t_(is_turret_ || control == "centurion") {}

/// T0303 and T303 are tool 3 with offset 3; of two digits and less the tool alone.
std::optional<std::uint64_t> ToolFinder::tool_of(const ScannedBlock& block) const {
  const auto word = std::ranges::find(block, 'T', &ScannedWord::letter);
  if (word == block.end()) return std::nullopt;
  const auto number = whole(word->value);
  const bool has_offset = has_offset_in_t_ && word->value.size() > 2;
  return has_offset && number ? std::optional(*number / 100) : number;
}

bool ToolFinder::is_tool_call(std::string_view block) const {
  constexpr std::string_view kCall = "TOOL CALL";
  std::string_view words = without_blanks(block.substr(0, block.find(';')));
  const auto begin = words.find_first_not_of("0123456789 ");
  if (begin == std::string_view::npos || !words.substr(begin).starts_with(kCall)) return false;
  words = without_blanks(words.substr(begin + kCall.size()));
  return whole(words.substr(0, words.find(' '))) == tool_;
}

/// A run begins with an event as a whole.
bool ToolFinder::is_event_with_tool(const ScannedBlock& block) const {
  const bool is_event = std::ranges::any_of(block, [](const ScannedWord& word) {
    return word.letter == 'G' && tenths(word.value) >= 1000;
  });
  return is_event && std::ranges::any_of(block, [&](const ScannedWord& word) {
           return word.letter == 'T' && whole(word.value) == tool_;
         });
}

bool ToolFinder::is_change(std::string_view text) {
  if (is_over_) return false;
  if (form_ == Form::PlainLanguage) return is_tool_call(text);
  const ScannedBlock block = scan_block(text);
  if (form_ == Form::Events) return is_event_with_tool(block);
  if (without_number(without_blanks(text)).starts_with('/')) {
    if (tool_of(block)) is_next_ = false;  // which tool is next is not known
    return false;
  }
  is_over_ = has_function(block, kEnds);
  if (std::ranges::find(block, 'T', &ScannedWord::letter) != block.end())
    is_next_ = tool_of(block) == tool_;
  if (!is_turret_ && !has_function(block, kChanges)) return false;
  return std::exchange(is_next_, false);
}

}  // namespace dripline::line
