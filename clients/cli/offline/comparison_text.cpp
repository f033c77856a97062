#include "clients/cli/offline/comparison_text.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "clients/cli/exit_status.hpp"
#include "clients/cli/text/terminal.hpp"

namespace dripline::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string with_spaces(std::string word) {
  for (char& c : word) {
    if (c == '_') c = ' ';
  }
  return word;
}

/// `3,2` of a unified listing; an empty range has the line before it. `before` lines of context are
/// in front, which in the normal form may be more than this program has.
std::string range_text(const Json& side, std::uint64_t before, std::uint64_t after) {
  const auto line = side.at("line").get<std::uint64_t>();
  const auto count = side.at("count").get<std::uint64_t>() + before + after;
  const std::uint64_t begin = line > before ? line - before : 1;
  return fmt::format("{},{}", count == 0 ? begin - 1 : begin, count);
}

void append_lines(std::string& text, const Json& lines, char mark, Style style, bool has_color) {
  for (const auto& line : lines)
    text += styled(mark + printable(line.get<std::string>()), style, has_color) + "\n";
}

std::string hunks_text(const Json& text_result, const ComparedNames& names, bool has_color) {
  std::string text = fmt::format("--- {}\n+++ {}\n", names.first, names.second);
  for (const auto& hunk : text_result.at("hunks")) {
    const auto& first = hunk.at("first");
    const auto& second = hunk.at("second");
    const std::uint64_t before = hunk.at("before").size(), after = hunk.at("after").size();
    text += styled(fmt::format("@@ -{} +{} @@ {}", range_text(first, before, after),
                               range_text(second, before, after), with_spaces(hunk.at("change"))),
                   Style::Faint, has_color);
    text += "\n";
    append_lines(text, hunk.at("before"), ' ', Style::Plain, has_color);
    append_lines(text, first.at("lines"), '-', Style::Bad, has_color);
    append_lines(text, second.at("lines"), '+', Style::Good, has_color);
    append_lines(text, hunk.at("after"), ' ', Style::Plain, has_color);
  }
  return text;
}

std::string counted(std::uint64_t count, std::string_view one, std::string_view several) {
  return fmt::format("{} {}", count, count == 1 ? one : several);
}

std::string text_summary(const Json& text) {
  return fmt::format(
      "{}: {} removed, {} added{}", counted(text.at("hunk_count"), "place", "places"),
      counted(text.at("removed"), "line", "lines"), text.at("added").get<std::uint64_t>(),
      text.at("complete") ? "" : "; not all of it is listed");
}

std::string side_text(const std::string& name, const Json& side) {
  std::string text = fmt::format("  {}:{}{}: {}", name, side.at("line").get<std::uint64_t>(),
                                 side.at("called") ? " (called)" : "",
                                 printable(side.at("text").get<std::string>()));
  const auto actions = side.at("actions").get<std::uint64_t>();
  if (actions == 0) return text + "\n      nothing here\n";
  text += fmt::format("\n      {}", printable(side.at("action").get<std::string>()));
  if (actions > 1)
    text += fmt::format(", and {}", counted(actions - 1, "action more", "actions more"));
  return text + "\n";
}

std::string compared_place(const Json& place, const ComparedNames& names, bool has_color) {
  std::string head;
  for (const auto& word : place.at("differences"))
    head += (head.empty() ? "" : ", ") + with_spaces(word);
  if (!place.at("distance").is_null())
    head += fmt::format(": {:.4f} mm apart", place.at("distance").get<double>());
  return styled(head, Style::Busy, has_color) + "\n" + side_text(names.first, place.at("first")) +
         side_text(names.second, place.at("second"));
}

std::string condition_text(const Json& condition, const ComparedNames& names) {
  const bool is_second = condition.at("program") == "second";
  const std::string kind = condition.at("kind");
  const std::string detail = condition.at("text");
  std::string reason = kind == "alarm"      ? "the program alarms: " + detail
                       : kind == "fault"    ? "the program could not be interpreted: " + detail
                       : kind == "probe"    ? "the program probes"
                       : kind == "prompt"   ? "the program asks its operator"
                       : kind == "input"    ? "the program reads an input"
                       : kind == "clock"    ? "the program reads the clock"
                       : kind == "variable" ? "the value may come from outside: " + detail
                       : kind == "start"    ? "it depends on the position at the start"
                                            : "a switch decides whether the block is skipped";
  return fmt::format("condition: {}:{}: {}: {}\n", is_second ? names.second : names.first,
                     condition.at("line").get<std::uint64_t>(), printable(reason),
                     printable(condition.at("line_text").get<std::string>()));
}

std::string motion_text(const Json& result, const ComparedNames& names, bool has_color) {
  const Json& motion = result.at("motion");
  std::string text;
  for (const auto& place : motion.at("places")) text += compared_place(place, names, has_color);
  for (const auto& condition : motion.at("conditions")) text += condition_text(condition, names);
  if (motion.at("same")) {
    const bool is_sure = motion.at("conditions").empty();
    text += fmt::format("{}: {} of {} and {}, within {:g} mm\n",
                        is_sure ? "same motion" : "same motion on these conditions",
                        counted(motion.at("actions").at("first"), "action", "actions"),
                        counted(motion.at("blocks").at("first"), "block", "blocks"),
                        motion.at("blocks").at("second").get<std::uint64_t>(),
                        motion.at("tolerance").get<double>());
  } else {
    std::string counts;
    for (const auto& [word, count] : motion.at("counts").items()) {
      counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", with_spaces(word),
                            count.get<std::uint64_t>());
    }
    text += fmt::format(
        "{}: {}", counted(motion.at("place_count"), "place differs", "places differ"), counts);
    if (motion.at("max_distance").get<double>() > 0)
      text += fmt::format("; paths up to {:.4f} mm apart", motion.at("max_distance").get<double>());
    text += motion.at("complete") ? "\n" : "; not all of them are listed\n";
  }
  if (motion.at("across_controls"))
    text += "two controls: what belongs to a control and not to the program is not compared\n";
  return text;
}

}  // namespace

std::string comparison_text(const Json& result, const ComparedNames& names, bool has_color) {
  std::string text;
  const Json& lines = result.at("text");
  if (result.contains("motion")) {
    text = motion_text(result, names, has_color);
    if (!lines.at("same")) text += "text: " + text_summary(lines) + "\n";
  } else if (lines.at("same")) {
    return {};
  } else {
    text = hunks_text(lines, names, has_color) + text_summary(lines) + "\n";
  }
  return text + fmt::format("class: {}\n", with_spaces(result.at("class")));
}

int comparison_status(const Json& result) {
  return result.at("same").get<bool>() ? kExitOk : kExitNo;
}

}  // namespace dripline::cli
