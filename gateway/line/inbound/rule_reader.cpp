#include "gateway/line/inbound/rule_reader.hpp"

#include <re2/re2.h>
#include <toml++/toml.h>
#include <array>

namespace dripline::line {
namespace {

constexpr std::size_t kMaxPattern = 256;
constexpr std::size_t kMaxWord = 128;
constexpr std::int64_t kPatternMemory = 256 * 1024;

constexpr std::array kActions{RuleAction::Send,    RuleAction::Directory, RuleAction::Restart,
                              RuleAction::NextJob, RuleAction::Program,   RuleAction::Report,
                              RuleAction::Ignore};

unsigned line_of(const toml::node& node) {
  return node.source().begin.line;
}

Result<std::string> read_text(std::string_view key, const toml::node& node,
                              std::size_t limit = kMaxWord) {
  const auto* text = node.as_string();
  if (text == nullptr)
    return fail(Errc::Syntax, "line {}: {} must be a string", line_of(node), key);
  if (text->get().size() > limit) {
    return fail(Errc::LimitExceeded, "line {}: {} of {} characters: at most {}", line_of(node), key,
                text->get().size(), limit);
  }
  return text->get();
}

Result<void> read_action(Rule& rule, const toml::node& node) {
  const auto text = read_text("action", node);
  if (!text) return fail(text.error());
  for (const auto action : kActions) {
    if (*text != to_string(action)) continue;
    rule.action = action;
    return {};
  }
  return fail(Errc::Syntax,
              "line {}: action '{}' is not send, directory, restart, next_job, program, report or "
              "ignore",
              line_of(node), *text);
}

Result<void> read_pattern(Rule& rule, const toml::node& node) {
  const auto text = read_text("matches", node, kMaxPattern);
  if (!text) return fail(text.error());
  re2::RE2::Options options;
  options.set_log_errors(false);
  options.set_max_mem(kPatternMemory);
  options.set_encoding(re2::RE2::Options::EncodingLatin1);
  auto pattern = std::make_shared<const re2::RE2>("(?m)" + *text, options);
  if (!pattern->ok()) {
    return fail(Errc::Syntax, "line {}: matches '{}': {}", line_of(node), *text, pattern->error());
  }
  rule.matches = std::move(pattern);
  return {};
}

Result<void> read_kind(Rule& rule, const toml::node& node) {
  const auto text = read_text("kind", node);
  if (!text) return fail(text.error());
  if (*text != "program" && *text != "line") {
    return fail(Errc::Syntax, "line {}: kind '{}' is not program or line", line_of(node), *text);
  }
  rule.kind = *text == "program" ? TextKind::Program : TextKind::Line;
  return {};
}

Result<void> read_probe(Rule& rule, const toml::node& node) {
  if (!node.is_boolean()) {
    return fail(Errc::Syntax, "line {}: probe must be true or false", line_of(node));
  }
  rule.is_probe = node.as_boolean()->get();
  return {};
}

/// That it is a string of a sensible length is known.
template <std::string Rule::*kMember>
Result<void> read_word(Rule& rule, const toml::node& node) {
  rule.*kMember = node.as_string()->get();
  return {};
}

struct KeyRow {
  std::string_view key;
  Result<void> (*read)(Rule&, const toml::node&);
};
constexpr std::array kKeys{
    KeyRow{"name", read_word<&Rule::name>},
    KeyRow{"program", read_word<&Rule::program>},
    KeyRow{"trigger", read_word<&Rule::trigger>},
    KeyRow{"matches", read_pattern},
    KeyRow{"kind", read_kind},
    KeyRow{"action", read_action},
    KeyRow{"argument", read_word<&Rule::argument>},
    KeyRow{"probe", read_probe},
};

/// What the rules of a set have in common.
struct SetHead {
  std::string name, program;
};

Result<void> check_rule(const Rule& rule, const toml::table& table) {
  if (!table.contains("action")) {
    return fail(Errc::Syntax, "line {}: rule '{}' has no action", line_of(table), rule.name);
  }
  if (rule.is_probe && rule.action != RuleAction::Report) {
    return fail(Errc::Syntax, "line {}: rule '{}': only a report can be a probe's", line_of(table),
                rule.name);
  }
  return {};
}

Result<Rule> read_rule(const toml::table& table, const SetHead& set, std::size_t number) {
  Rule rule;
  rule.name = fmt::format("rule {}", number);
  rule.program = set.program;
  for (const auto& [key, node] : table) {
    const std::string_view word = key.str();
    const auto* row =
        std::find_if(kKeys.begin(), kKeys.end(), [&](const KeyRow& r) { return r.key == word; });
    if (row == kKeys.end()) {
      return fail(Errc::Syntax, "line {}: key '{}' of a rule is not known", line_of(node), word);
    }
    if (word != "probe") {
      if (auto text = read_text(word, node, kMaxPattern); !text) return fail(text.error());
    }
    if (auto read = row->read(rule, node); !read) return fail(read.error());
  }
  if (!set.name.empty()) rule.name = set.name + "/" + rule.name;
  if (auto checked = check_rule(rule, table); !checked) return fail(checked.error());
  return rule;
}

Result<void> read_rule_array(const toml::node& node, const SetHead& set, std::vector<Rule>& rules) {
  const auto* array = node.as_array();
  if (array == nullptr) return fail(Errc::Syntax, "line {}: write [[rule]]", line_of(node));
  std::size_t number = 0;
  for (const auto& element : *array) {
    if (!element.is_table()) return fail(Errc::Syntax, "line {}: write [[rule]]", line_of(element));
    auto rule = read_rule(*element.as_table(), set, ++number);
    if (!rule) return fail(rule.error());
    if (rules.size() >= RuleSet::kMaxRules) {
      return fail(Errc::LimitExceeded, "line {}: more than {} rules", line_of(element),
                  RuleSet::kMaxRules);
    }
    rules.push_back(*std::move(rule));
  }
  return {};
}

Result<void> read_set(const toml::table& table, std::vector<Rule>& rules) {
  SetHead head;
  for (const auto& [key, node] : table) {
    if (key.str() == "rule") continue;
    if (key.str() != "name" && key.str() != "program") {
      return fail(Errc::Syntax, "line {}: key '{}' of a set is not known", line_of(node),
                  key.str());
    }
    auto text = read_text(key.str(), node);
    if (!text) return fail(text.error());
    (key.str() == "name" ? head.name : head.program) = *std::move(text);
  }
  const auto* rules_of_set = table.get("rule");
  return rules_of_set == nullptr ? Result<void>{} : read_rule_array(*rules_of_set, head, rules);
}

Result<void> read_sets(const toml::node& node, std::vector<Rule>& rules) {
  const auto* array = node.as_array();
  if (array == nullptr) return fail(Errc::Syntax, "line {}: write [[set]]", line_of(node));
  for (const auto& element : *array) {
    if (!element.is_table()) return fail(Errc::Syntax, "line {}: write [[set]]", line_of(element));
    if (auto read = read_set(*element.as_table(), rules); !read) return read;
  }
  return {};
}

Result<RuleSet> read_table(const toml::table& table) {
  std::vector<Rule> rules;
  std::string reply;
  for (const auto& [key, node] : table) {
    if (key.str() == "rule" || key.str() == "set") continue;
    if (key.str() != "reply") {
      return fail(Errc::Syntax, "line {}: key '{}' is not known", line_of(node), key.str());
    }
    auto text = read_text("reply", node);
    if (!text) return fail(text.error());
    reply = *std::move(text);
  }
  if (const auto* node = table.get("rule")) {
    if (auto read = read_rule_array(*node, {}, rules); !read) return fail(read.error());
  }
  if (const auto* node = table.get("set")) {
    if (auto read = read_sets(*node, rules); !read) return fail(read.error());
  }
  return RuleSet(std::move(rules), std::move(reply));
}

}  // namespace

Result<RuleSet> read_rules(std::string_view toml) {
  try {
    return read_table(toml::parse(toml));
  } catch (const toml::parse_error& e) {
    return fail(Errc::Syntax, "line {}: {}", e.source().begin.line, e.description());
  }
}

}  // namespace dripline::line
