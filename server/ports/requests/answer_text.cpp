#include "server/ports/requests/answer_text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <map>

#include "server/ports/programs/program_head.hpp"

namespace dripline::ports {
namespace {

constexpr std::size_t kMaxComment = 60;
constexpr std::string_view kSigns = " .-+/=:,";

bool is_offered(const storage::ProgramSummary& program, const std::string& control) {
  const auto& latest = program.latest;
  if (program.is_removed || latest.is_held) return false;
  return control.empty() || latest.control.empty() || latest.control == control;
}

}  // namespace

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

std::vector<std::string> listing(std::span<const storage::ProgramSummary> programs,
                                 const std::string& control) {
  std::vector<std::string> lines;
  std::size_t more = 0;
  for (const auto& program : programs) {
    if (!is_offered(program, control)) continue;
    if (lines.size() >= kMaxListed) {
      ++more;
      continue;
    }
    const auto& latest = program.latest;
    lines.push_back(fmt::format("{} {}{}{}", latest.program, latest.size,
                                latest.comment.empty() ? "" : " ", latest.comment.substr(0, 30)));
  }
  if (more > 0) lines.push_back(fmt::format("AND {} MORE", more));
  return lines;
}

std::vector<storage::Revision> numbered_programs(std::span<const storage::ProgramSummary> programs,
                                                 const std::string& control) {
  std::map<std::pair<std::size_t, std::string>, storage::Revision> in_order;
  for (const auto& program : programs) {
    const std::string number = program_number(program.latest.program);
    const bool is_for_it = !control.empty() && program.latest.control == control;
    if (number.empty() || !is_for_it || !is_offered(program, control)) continue;
    in_order.emplace(std::pair(number.size(), number), program.latest);
  }
  std::vector<storage::Revision> revisions;
  for (auto& [number, revision] : in_order) revisions.push_back(std::move(revision));
  return revisions;
}

}  // namespace dripline::ports
