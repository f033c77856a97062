#include "gateway/line/inbound/rule_set.hpp"

#include <re2/re2.h>
#include <algorithm>

#include "gateway/line/inbound/inbound_splitter.hpp"
#include "gateway/line/inbound/program_head.hpp"

namespace dripline::line {
namespace {

constexpr std::size_t kMaxExplainedLines = 50;

/// Whether one condition of a rule holds; what it found, and why not, in words.
struct Finding {
  bool is_found = true;
  std::string value;
  std::string why;
};

Finding look_for_program(const Rule& rule, TextKind kind, std::string_view text) {
  if (kind == TextKind::Line) return {.is_found = false, .value = {}, .why = "it is no program"};
  const std::string name = program_name(text);
  if (is_same_program(name, rule.program)) return {.is_found = true, .value = name, .why = {}};
  return {.is_found = false,
          .value = {},
          .why = fmt::format("the program is {}, not {}", name.empty() ? "without a name" : name,
                             rule.program)};
}

Finding look_for_trigger(const Rule& rule, std::string_view text) {
  auto value = find_trigger(text, rule.trigger);
  if (value) return {.is_found = true, .value = *std::move(value), .why = {}};
  return {.is_found = false, .value = {}, .why = fmt::format("no comment ({})", rule.trigger)};
}

Finding look_for_pattern(const Rule& rule, std::string_view text) {
  const auto& pattern = *rule.matches;
  re2::StringPiece groups[2];
  const int count = std::min(2, pattern.NumberOfCapturingGroups() + 1);
  const re2::StringPiece piece(text.data(), text.size());
  if (!pattern.Match(piece, 0, text.size(), re2::RE2::UNANCHORED, groups, count)) {
    return {
        .is_found = false, .value = {}, .why = fmt::format("'{}' is not found", pattern.pattern())};
  }
  const auto& found = groups[count - 1];
  return {.is_found = true, .value = std::string(found.data(), found.size()), .why = {}};
}

/// All conditions; the value of the last that has one.
Finding look(const Rule& rule, TextKind kind, std::string_view text) {
  if (rule.kind && *rule.kind != kind) {
    return {.is_found = false,
            .value = {},
            .why = kind == TextKind::Program ? "it is for lines" : "it is for programs"};
  }
  Finding all;
  const auto add = [&](Finding next) {
    if (next.is_found && next.value.empty()) next.value = all.value;
    if (all.is_found) all = std::move(next);
  };
  if (!rule.program.empty()) add(look_for_program(rule, kind, text));
  if (!rule.trigger.empty()) add(look_for_trigger(rule, text));
  if (rule.matches) add(look_for_pattern(rule, text));
  return all;
}

std::string fill_in(const std::string& argument, const std::string& value) {
  std::string text = argument;
  if (const auto at = text.find("{}"); at != std::string::npos) text.replace(at, 2, value);
  return text;
}

}  // namespace

std::string_view to_string(RuleAction action) {
  constexpr std::string_view kWords[] = {"send",    "directory", "restart", "next_job",
                                         "program", "report",    "ignore"};
  return kWords[static_cast<std::size_t>(action)];
}

RuleHit RuleSet::judge(TextKind kind, std::string_view text, std::vector<std::string>* why) const {
  text = text.substr(0, kProgramHead);
  for (const auto& rule : rules_) {
    const Finding finding = look(rule, kind, text);
    if (!finding.is_found) {
      if (why != nullptr) why->push_back(fmt::format("{}: {}", rule.name, finding.why));
      continue;
    }
    if (why != nullptr) why->push_back(fmt::format("{}: fires", rule.name));
    return {.rule = &rule,
            .action = rule.action,
            .argument = fill_in(rule.argument, finding.value),
            .is_probe = rule.is_probe};
  }
  if (kind == TextKind::Line) return {};
  return {.rule = nullptr,
          .action = RuleAction::Program,
          .argument = program_name(text),
          .is_probe = false};
}

RuleVerdict RuleSet::explain(const std::string& text, bool extracts) const {
  InboundSplitter intake(*this, extracts);
  auto items = intake.take(text);
  for (auto& item : intake.end()) items.push_back(std::move(item));
  RuleVerdict verdict;
  std::size_t lines = 0;
  for (const auto& item : items) {
    const bool is_line = item.what == InboundSplitter::Item::What::Line;
    if (!is_line && item.what != InboundSplitter::Item::What::ProgramEnded) continue;
    if (++lines > kMaxExplainedLines) break;
    verdict.why.push_back(is_line ? fmt::format("a line that is printed: {}", item.text)
                                  : fmt::format("a program {}", program_name(item.text)));
    const auto hit = judge(is_line ? TextKind::Line : TextKind::Program, item.text, &verdict.why);
    // The first text that a rule speaks of, or else the first one.
    if (!verdict.rule.empty() || (hit.rule == nullptr && !verdict.action.empty())) continue;
    verdict.rule = hit.rule != nullptr ? hit.rule->name : "";
    verdict.action = to_string(hit.action);
    verdict.argument = hit.argument;
    if (hit.rule == nullptr) verdict.why.emplace_back("no rule fires: the default");
  }
  if (items.empty()) {
    verdict.action = "ignore";
    verdict.why.emplace_back("there is no text");
  }
  return verdict;
}

}  // namespace dripline::line
