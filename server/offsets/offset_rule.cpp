#include "server/offsets/offset_rule.hpp"

#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "server/offsets/setup_value.hpp"

namespace dripline::offsets {
namespace {

/// Reads one table and keeps the first error.
class RuleReader {
 public:
  explicit RuleReader(const toml::table& table) : table_(table) {}

  void text(const char* key, std::string& into) {
    const auto* node = take(key);
    if (node == nullptr) return refuse(table_, fmt::format("{} is missing", key));
    const auto value = node->value<std::string>();
    if (!node->is_string() || value->empty())
      return refuse(*node, fmt::format("{}: a text is expected", key));
    into = *value;
  }
  void optional_text(const char* key, std::string& into) {
    if (table_.contains(key)) text(key, into);
  }
  /// T3 in quotes, or the bare number.
  void tool(const char* key, std::string& into) {
    const auto* node = take(key);
    if (node == nullptr) return;
    const auto number = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
    if (number && *number < 0)
      return refuse(*node, fmt::format("{}: tool {} is below 0", key, *number));
    if (!number && !node->is_string())
      return refuse(*node, fmt::format("{}: a tool is expected, 3 or \"T3\"", key));
    if (!number) return text(key, into);
    into = fmt::format("T{}", *number);
  }
  void number(const char* key, double& into, double low, double high) {
    const auto* node = take(key);
    if (node == nullptr) return;
    const auto value = node->is_number() ? node->value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value))
      return refuse(*node, fmt::format("{}: a number is expected", key));
    if (*value < low || *value > high) {
      return refuse(*node, fmt::format("{} is {}: {} to {} are possible", key, *value, low, high),
                    Errc::LimitExceeded);
    }
    into = *value;
  }
  void number(const char* key, std::optional<double>& into) {
    if (!table_.contains(key)) return;
    double value = 0;
    number(key, value, -kMost, kMost);
    into = value;
  }
  template <class T>
  void count(const char* key, T& into, double low, double high) {
    auto value = static_cast<double>(into);
    number(key, value, low, high);
    if (value != std::floor(value))
      return refuse(table_, fmt::format("{} is {}: a whole number is expected", key, value));
    into = static_cast<T>(value);
  }
  void check(bool is_good, const std::string& what) {
    if (!is_good) refuse(table_, what, Errc::LimitExceeded);
  }
  Result<void> finish() {
    for (const auto& [key, node] : table_) {
      if (!known_.contains(key.str()))
        refuse(node, fmt::format("{} is not a key of a rule", key.str()));
    }
    if (error_) return fail(*error_);
    return {};
  }

  static constexpr double kMost = 1e6;

 private:
  const toml::node* take(const char* key) {
    known_.insert(key);
    return table_.get(key);
  }
  void refuse(const toml::node& node, const std::string& what, Errc code = Errc::Syntax) {
    if (!error_) error_ = Error{code, fmt::format("line {}: {}", node.source().begin.line, what)};
  }

  const toml::table& table_;
  std::set<std::string, std::less<>> known_;
  std::optional<Error> error_;
};

Result<OffsetRule> read_rule(const toml::table& table) {
  constexpr double kMost = RuleReader::kMost;
  RuleReader reader(table);
  OffsetRule rule;
  reader.text("name", rule.name);
  reader.text("characteristic", rule.characteristic);
  reader.text("target", rule.target);
  reader.optional_text("program", rule.program);
  reader.tool("tool", rule.tool);
  reader.optional_text("template", rule.template_name);
  reader.number("scale", rule.scale, -100, 100);
  reader.number("gain", rule.gain, 0.01, 1);
  reader.number("dead_band", rule.dead_band, 0, kMost);
  reader.number("max_step", rule.max_step, 0, kMost);
  reader.count("min_count", rule.min_count, 1, 1000);
  reader.count("window", rule.window, 1, 1000);
  reader.number("outlier", rule.outlier, 0, 100);
  reader.number("lowest", rule.lowest);
  reader.number("highest", rule.highest);
  reader.number("automatic", rule.automatic, 0, kMost);
  reader.count("decimals", rule.decimals, 0, 9);
  reader.check(rule.max_step > 0, "max_step must be given, and above 0");
  reader.check(rule.scale != 0, "scale must not be 0");
  reader.check(rule.window >= rule.min_count,
               fmt::format("window {} is less than min_count {}", rule.window, rule.min_count));
  reader.check(!rule.lowest || !rule.highest || *rule.lowest < *rule.highest,
               "lowest is not below highest");
  if (auto good = reader.finish(); !good) return fail(good.error());
  if (auto target = parse_setup_target(rule.target); !target) {
    return fail(target.error().code, "rule {}: {}", rule.name, target.error().what);
  }
  return rule;
}

/// T3 and T03 are one tool.
std::string name_of(const SetupTarget& target) {
  return fmt::format("{} {}.{}", owner_of(target),
                     target.kind == SetupTarget::Kind::Wear ? "wear" : "", target.key);
}

Result<void> check_distinct(const std::vector<OffsetRule>& rules) {
  std::set<std::string> names, targets;
  for (const OffsetRule& rule : rules) {
    if (!names.insert(rule.name).second)
      return fail(Errc::Conflict, "two rules have the name {}", rule.name);
    const auto target = parse_setup_target(rule.target);
    if (!target) return fail(target.error());
    if (!targets.insert(name_of(*target)).second) {
      return fail(Errc::Conflict, "rule {}: {} is corrected by another rule already", rule.name,
                  rule.target);
    }
  }
  return {};
}

}  // namespace

std::string scope_text(const OffsetRule& rule) {
  std::string text;
  const auto add = [&](std::string_view what, const std::string& name) {
    if (!name.empty()) text += fmt::format("{}{} {}", text.empty() ? "" : " ", what, name);
  };
  add("of program", rule.program);
  add("by tool", rule.tool);
  add("read by template", rule.template_name);
  return text;
}

bool has_same_scope(const OffsetRule& a, const OffsetRule& b) {
  return a.characteristic == b.characteristic && a.program == b.program &&
         bare_tool(a.tool) == bare_tool(b.tool) && a.template_name == b.template_name;
}

std::string bare_tool(std::string_view tool) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::string_view bare = tool;
  if (bare.size() > 1 && (bare[0] == 'T' || bare[0] == 't') && is_digit(bare[1]))
    bare.remove_prefix(1);
  if (!std::ranges::all_of(bare, is_digit)) return std::string(tool);
  while (bare.size() > 1 && bare[0] == '0') bare.remove_prefix(1);
  return std::string(bare);
}

Result<std::vector<OffsetRule>> parse_offset_rules(std::string_view text) {
  if (text.size() > kMaxRuleText)
    return fail(Errc::LimitExceeded, "offset rules of {} bytes, at most {}", text.size(),
                kMaxRuleText);
  toml::table document;
  try {
    document = toml::parse(text);
  } catch (const toml::parse_error& unread) {  // what the library reports with
    return fail(Errc::Syntax, "line {}: {}", unread.source().begin.line, unread.description());
  }
  std::vector<OffsetRule> rules;
  for (const auto& [key, node] : document) {
    if (key.str() != "rule" || !node.is_array_of_tables())
      return fail(Errc::Syntax, "line {}: {}: only [[rule]] is expected", node.source().begin.line,
                  key.str());
    for (const toml::node& one : *node.as_array()) {
      auto rule = read_rule(*one.as_table());
      if (!rule) return fail(rule.error());
      if (rules.size() == kMaxRules) return fail(Errc::LimitExceeded, "over {} rules", kMaxRules);
      rules.push_back(*std::move(rule));
    }
  }
  if (auto good = check_distinct(rules); !good) return fail(good.error());
  return rules;
}

}  // namespace dripline::offsets
