#include "clients/cli/offline/text_search_options.hpp"

#include <fmt/format.h>
#include <charconv>
#include <nlohmann/json.hpp>

#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

using program_editing::BlockChange;
using program_editing::TextPattern;

/// "10..40". Errors: Syntax.
Result<std::pair<std::int64_t, std::int64_t>> line_range_of(std::string_view text) {
  std::uint32_t first = 0, last = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, first);
  const auto rest = text.substr(static_cast<std::size_t>(read.ptr - text.data()));
  if (read.ec == std::errc{} && rest.starts_with("..")) {
    const auto second = std::from_chars(read.ptr + 2, end, last);
    if (second.ec == std::errc{} && second.ptr == end)
      return std::pair<std::int64_t, std::int64_t>(first, last);
  }
  return fail(Errc::Syntax, "--within {}: expected lines as 10..40", text);
}

}  // namespace

void TextSearchOptions::add_to(Command command) {
  command
      .add_option("--find-text", wanted_,
                  "List the lines with this text, up to 67 characters; not for numbered blocks")
      .type_name("TEXT")
      .allow_extra_args(false);
  command
      .add_option("--change", replacements_,
                  "Change a text to another wherever it occurs; not for numbered blocks")
      .type_name("OLD NEW")
      .allow_extra_args(false);
  command.add_option("--within", within_, "Find and change in these lines only: 10..40")
      .type_name("LINES");
  command.add_flag("--ignore-case", ignores_case_, "Find and change g1 as G1");
  command.add_flag("--whole-words", is_whole_word_, "Find and change no part of a longer word");
}

Result<void> TextSearchOptions::check() const {
  const bool has_options = ignores_case_ || is_whole_word_ || !within_.empty();
  if (has_options && !finds() && !changes()) {
    return fail(Errc::Syntax,
                "--within, --ignore-case and --whole-words are of --find-text and --change");
  }
  return {};
}

Result<TextPattern> TextSearchOptions::pattern(const EditedText& original,
                                               const std::string& text) const {
  if (original.editor() != nullptr) {
    return fail(Errc::Unsupported,
                "{}: its control keeps numbered blocks of words: use --find and --set",
                original.name());
  }
  TextPattern pattern{text, ignores_case_, is_whole_word_, {}};
  if (within_.empty()) return pattern;
  const auto lines = line_range_of(within_);
  if (!lines) return fail(lines.error());
  pattern.lines = *lines;
  return pattern;
}

int TextSearchOptions::show(Context& context, const EditedText& original) const {
  auto blocks = nlohmann::ordered_json::array();
  std::string text;
  bool has_found = false;
  for (const auto& wanted : wanted_) {
    const auto looked_for = pattern(original, wanted);
    if (!looked_for) return complain(looked_for.error()), kExitUsage;
    const auto found = program_editing::find_text(original.text(), *looked_for);
    if (!found) return complain(found.error()), kExitNo;
    has_found |= !found->empty();
    for (const auto& line : *found) {
      blocks.push_back({{"block", line.block}, {"line", line.line}, {"text", line.text}});
      text += fmt::format("{}: {}\n", line.block, printable(line.text));
    }
    if (found->empty()) text += fmt::format("No line has {}.\n", printable(wanted));
  }
  context.print(context.wants_json
                    ? json_text(nlohmann::ordered_json{{"blocks", std::move(blocks)},
                                                       {"unread", nlohmann::ordered_json::array()}})
                    : text);
  return has_found ? kExitOk : kExitNo;
}

Result<void> TextSearchOptions::add_changes(const EditedText& original,
                                            std::vector<BlockChange>& changes) const {
  for (const auto& [old_text, new_text] : replacements_) {
    const auto looked_for = pattern(original, old_text);
    if (!looked_for) return fail(looked_for.error());
    auto changed = program_editing::change_text(original.text(), *looked_for, new_text);
    if (!changed) return fail(changed.error());
    changes.insert(changes.end(), changed->begin(), changed->end());
  }
  return {};
}

}  // namespace dripline::cli
