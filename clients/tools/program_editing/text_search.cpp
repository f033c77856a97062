#include "clients/tools/program_editing/text_search.hpp"

#include <algorithm>

#include "protocol/base/lines.hpp"

namespace dripline::program_editing {
namespace {

char upper(char letter) {
  return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
}

bool is_word_character(char letter) {
  const char big = upper(letter);
  return (big >= 'A' && big <= 'Z') || (big >= '0' && big <= '9') || big == '_';
}

bool is_digit(char letter) {
  return letter >= '0' && letter <= '9';
}

/// Whether what is before `at` is the sign of a number there, and not an operator: "Y-1", "=-1"
/// and not "P1-1".
bool is_signed(std::string_view line, std::size_t at) {
  if (line[at - 1] != '-' && line[at - 1] != '+') return false;
  if (at == 1) return true;
  const char before = line[at - 2];
  return !is_digit(before) && before != '.' && before != ')' && before != ']';
}

/// A number is one word with its sign, its point and the digits after it.
bool is_whole(std::string_view line, std::size_t at, std::size_t size) {
  const std::size_t end = at + size;
  if (at != 0) {
    const char before = line[at - 1];
    if (is_word_character(before)) return false;
    const bool is_number = is_digit(line[at]) || line[at] == '.';
    if (is_number && (before == '.' || is_signed(line, at))) return false;
  }
  if (end == line.size()) return true;
  return !is_word_character(line[end]) && !(is_digit(line[end - 1]) && line[end] == '.');
}

std::size_t next_in(std::string_view line, const TextPattern& pattern, std::size_t from) {
  const auto is_same = [&](char left, char right) {
    return pattern.ignores_case ? upper(left) == upper(right) : left == right;
  };
  while (from <= line.size()) {
    const auto begin = line.begin() + static_cast<std::ptrdiff_t>(from);
    const auto found =
        std::search(begin, line.end(), pattern.text.begin(), pattern.text.end(), is_same);
    if (found == line.end()) break;
    const auto at = static_cast<std::size_t>(found - line.begin());
    if (!pattern.is_whole_word || is_whole(line, at, pattern.text.size())) return at;
    from = at + 1;
  }
  return std::string_view::npos;
}

Result<void> check_text(std::string_view option, std::string_view text) {
  if (text.find_first_of("\r\n") != std::string_view::npos) {
    return fail(Errc::Syntax, "the text to {} has several lines: expected a part of one", option);
  }
  if (text.size() > kMaxFindText) {
    return fail(Errc::LimitExceeded, "the text to {} has {} characters, more than {}", option,
                text.size(), kMaxFindText);
  }
  return {};
}

Result<void> check_pattern(const TextPattern& pattern, std::size_t lines) {
  if (pattern.text.empty()) return fail(Errc::Syntax, "the text to find is empty");
  if (auto checked = check_text("find", pattern.text); !checked) return checked;
  if (!pattern.lines) return {};
  const auto [first, last] = *pattern.lines;
  if (last < first) {
    return fail(Errc::Syntax, "lines {}..{}: the range runs backwards", first, last);
  }
  if (first < 1 || last > static_cast<std::int64_t>(lines)) {
    return fail(Errc::NotFound, "lines {}..{}: the program has lines 1 to {}", first, last, lines);
  }
  return {};
}

/// Without their ends.
std::vector<std::string_view> bare_lines_of(std::string_view text) {
  std::vector<std::string_view> lines = lines_with_ends(text);
  for (std::string_view& line : lines) {
    for (const char end : {'\n', '\r'}) {
      if (line.ends_with(end)) line.remove_suffix(1);
    }
  }
  return lines;
}

std::string changed_line(std::string_view line, const TextPattern& pattern,
                         std::string_view replacement) {
  std::string changed;
  std::size_t from = 0;
  for (std::size_t at = next_in(line, pattern, 0); at != std::string_view::npos;
       at = next_in(line, pattern, from)) {
    changed += line.substr(from, at - from);
    changed += replacement;
    from = at + pattern.text.size();
  }
  changed += line.substr(from);
  return changed;
}

}  // namespace

Result<std::vector<WordSearch::Found>> find_text(std::string_view text,
                                                 const TextPattern& pattern) {
  const auto lines = bare_lines_of(text);
  if (auto checked = check_pattern(pattern, lines.size()); !checked) return fail(checked.error());
  std::vector<WordSearch::Found> found;
  const auto range = pattern.lines.value_or(
      std::pair<std::int64_t, std::int64_t>(1, static_cast<std::int64_t>(lines.size())));
  for (std::int64_t number = range.first; number <= range.second; ++number) {
    const std::string_view line = lines[static_cast<std::size_t>(number - 1)];
    if (next_in(line, pattern, 0) == std::string_view::npos) continue;
    found.push_back({number, static_cast<std::uint64_t>(number), std::string(line)});
  }
  return found;
}

Result<std::vector<BlockChange>> change_text(std::string_view text, const TextPattern& pattern,
                                             std::string_view replacement) {
  if (auto checked = check_text("put in", replacement); !checked) return fail(checked.error());
  const auto found = find_text(text, pattern);
  if (!found) return fail(found.error());
  if (found->empty()) return fail(Errc::NotFound, "no line has \"{}\"", pattern.text);
  std::vector<BlockChange> changes;
  for (const auto& line : *found) {
    std::string changed = changed_line(line.text, pattern, replacement);
    if (changed.find_first_not_of(" \t") == std::string::npos) {
      return fail(Errc::Conflict, "line {} would be blank: delete it instead", line.block);
    }
    changes.push_back({BlockChange::Kind::Replace, line.block, line.block, std::move(changed)});
  }
  return changes;
}

}  // namespace dripline::program_editing
