#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "clients/tools/report_template/report_template.hpp"

namespace dripline::report_template {
namespace {

using measurement::ReworkSide;

unsigned line_of(const toml::node& node) {
  return node.source().begin.line;
}

Result<std::string> read_text(std::string_view key, const toml::node& node,
                              std::size_t limit = kMaxName) {
  const auto* text = node.as_string();
  if (text == nullptr)
    return fail(Errc::Syntax, "line {}: {} must be a string", line_of(node), key);
  if (text->get().size() > limit) {
    return fail(Errc::LimitExceeded, "line {}: {} of {} characters: at most {}", line_of(node), key,
                text->get().size(), limit);
  }
  return text->get();
}

Result<double> read_value(std::string_view key, const toml::node& node) {
  const auto value = node.value<double>();
  if (!node.is_number() || !value || !std::isfinite(*value))
    return fail(Errc::Syntax, "line {}: {} must be a number", line_of(node), key);
  return *value;
}

Result<std::int64_t> read_count(std::string_view key, const toml::node& node, std::int64_t limit) {
  const auto value = node.value_exact<std::int64_t>();
  if (!value || *value < 0 || *value > limit) {
    return fail(Errc::LimitExceeded, "line {}: {} must be a whole number from 0 to {}",
                line_of(node), key, limit);
  }
  return *value;
}

Result<bool> read_flag(std::string_view key, const toml::node& node) {
  const auto value = node.value_exact<bool>();
  if (!value) return fail(Errc::Syntax, "line {}: {} must be true or false", line_of(node), key);
  return *value;
}

/// One of these words, as its place in the list.
template <std::size_t kCount>
Result<std::size_t> read_choice(std::string_view key, const toml::node& node,
                                const std::array<std::string_view, kCount>& words) {
  const auto text = read_text(key, node);
  if (!text) return fail(text.error());
  const auto found = std::ranges::find(words, *text);
  if (found == words.end()) {
    return fail(Errc::Syntax, "line {}: {} '{}' is none of {}", line_of(node), key, *text,
                fmt::join(words, ", "));
  }
  return static_cast<std::size_t>(found - words.begin());
}

constexpr std::array<std::string_view, 4> kSides{"none", "below", "above", "both"};
constexpr std::array<std::string_view, 3> kActions{"none", "hold_queue", "hold_machine"};
constexpr std::array<std::string_view, 2> kProbeAxes{"all", "moved"};
constexpr std::array<std::string_view, 3> kSources{"output", "probe", "message"};

struct NumberRow {
  std::string_view key;
  std::optional<double> Definition::*member;
};
constexpr std::array kNumbers{
    NumberRow{"nominal", &Definition::nominal},
    NumberRow{"lower", &Definition::lower},
    NumberRow{"upper", &Definition::upper},
    NumberRow{"tolerance", &Definition::tolerance},
    NumberRow{"upper_deviation", &Definition::upper_deviation},
    NumberRow{"lower_deviation", &Definition::lower_deviation},
};

/// A key that all definitions have. False: it is another.
Result<bool> read_definition_key(Definition& definition, std::string_view key,
                                 const toml::node& node) {
  const auto* row = std::ranges::find(kNumbers, key, &NumberRow::key);
  if (row != kNumbers.end()) {
    const auto value = read_value(key, node);
    if (!value) return fail(value.error());
    definition.*(row->member) = *value;
    return true;
  }
  if (key == "rework") {
    const auto side = read_choice(key, node, kSides);
    if (!side) return fail(side.error());
    definition.rework = static_cast<ReworkSide>(*side);
    return true;
  }
  if (key == "decimals") {
    const auto decimals = read_count(key, node, 9);
    if (!decimals) return fail(decimals.error());
    definition.decimals = static_cast<std::uint8_t>(*decimals);
    return true;
  }
  if (key != "unit" && key != "tool") return false;
  auto text = read_text(key, node);
  if (!text) return fail(text.error());
  (key == "unit" ? definition.unit : definition.tool) = *std::move(text);
  return true;
}

Result<void> check_definition(const Definition& definition, const toml::node& node) {
  if (definition.lower && definition.upper && *definition.lower > *definition.upper) {
    return fail(Errc::Conflict, "line {}: lower {} is above upper {}", line_of(node),
                *definition.lower, *definition.upper);
  }
  if (definition.tolerance && *definition.tolerance < 0) {
    return fail(Errc::Conflict, "line {}: tolerance {} is negative", line_of(node),
                *definition.tolerance);
  }
  if (definition.tolerance && (definition.lower || definition.upper || definition.lower_deviation ||
                               definition.upper_deviation)) {
    return fail(Errc::Conflict, "line {}: a tolerance beside limits", line_of(node));
  }
  return {};
}

Result<void> unknown_key(std::string_view key, const toml::node& node, std::string_view where) {
  return fail(Errc::Syntax, "line {}: key '{}' of {} is not known", line_of(node), key, where);
}

/// What is written for one kind of line.
class RuleReader {
 public:
  explicit RuleReader(bool has_decimal_comma) : has_decimal_comma_(has_decimal_comma) {}

  Result<LineRule> read(const toml::table& table) {
    LineRule rule;
    rule.line = line_of(table);
    for (const auto& [name, node] : table) {
      if (auto done = read_key(rule, name.str(), node); !done) return fail(done.error());
    }
    if (rule.steps.empty())
      return fail(Errc::Syntax, "line {}: a line needs a form or a pattern", rule.line);
    if (rule.is_ignored && rule.steps.size() > 1)
      return fail(Errc::Conflict, "line {}: what is ignored has one form", rule.line);
    if (auto good = check_definition(rule.definition, table); !good) return fail(good.error());
    return rule;
  }

 private:
  Result<void> read_key(LineRule& rule, std::string_view key, const toml::node& node) {
    if (key == "form" || key == "pattern") return read_forms(rule, key, node);
    if (key == "characteristic") {
      auto text = read_text(key, node);
      if (!text) return fail(text.error());
      rule.characteristic = *std::move(text);
      return {};
    }
    if (key == "ignore" || key == "starts_part" || key == "ends_part") {
      const auto flag = read_flag(key, node);
      if (!flag) return fail(flag.error());
      (key == "ignore"        ? rule.is_ignored
       : key == "starts_part" ? rule.starts_part
                              : rule.ends_part) = *flag;
      return {};
    }
    const auto known = read_definition_key(rule.definition, key, node);
    if (!known) return fail(known.error());
    return *known ? Result<void>{} : unknown_key(key, node, "a line");
  }

  Result<void> read_forms(LineRule& rule, std::string_view key, const toml::node& node) {
    if (!rule.steps.empty())
      return fail(Errc::Conflict, "line {}: a line has a form or a pattern", line_of(node));
    if (const auto* array = node.as_array(); array != nullptr) {
      if (array->size() > kMaxSteps) {
        return fail(Errc::LimitExceeded, "line {}: {} lines that follow each other: at most {}",
                    line_of(node), array->size(), kMaxSteps);
      }
      for (const auto& element : *array) {
        if (auto done = read_form(rule, key, element); !done) return done;
      }
      return {};
    }
    return read_form(rule, key, node);
  }

  Result<void> read_form(LineRule& rule, std::string_view key, const toml::node& node) {
    const auto text = read_text(key, node, kMaxForm);
    if (!text) return fail(text.error());
    auto form =
        key == "form" ? LineForm::of_form(*text, has_decimal_comma_) : LineForm::of_pattern(*text);
    if (!form) {
      return fail(form.error().code, "line {}: {}", line_of(node), form.error().what);
    }
    rule.steps.push_back(*std::move(form));
    return {};
  }

  const bool has_decimal_comma_;
};

class FileReader {
 public:
  Result<ReportTemplate> read(const toml::table& table) {
    // Forms depend on it, wherever it is written.
    if (const auto* comma = table.get("decimal_comma"); comma != nullptr) {
      const auto flag = read_flag("decimal_comma", *comma);
      if (!flag) return fail(flag.error());
      has_decimal_comma_ = *flag;
    }
    for (const auto& [name, node] : table) {
      if (auto done = read_key(name.str(), node); !done) return fail(done.error());
    }
    if (made_.rules.empty()) return fail(Errc::Syntax, "the template has no [[line]]");
    if (auto good = check_definition(made_.defaults, table); !good) return fail(good.error());
    return std::move(made_);
  }

 private:
  Result<void> read_key(std::string_view key, const toml::node& node) {
    if (key == "decimal_comma") return {};
    if (key == "line") return read_rules(node);
    if (key == "characteristic") return read_characteristics(node);
    if (key == "verdict") return read_actions(node);
    if (key == "sources") return read_sources(node);
    if (key == "probe_axes") {
      const auto axes = read_choice(key, node, kProbeAxes);
      if (!axes) return fail(axes.error());
      made_.probe_axes = static_cast<ProbeAxes>(*axes);
      return {};
    }
    if (key == "title" || key == "device") {
      auto text = read_text(key, node);
      if (!text) return fail(text.error());
      (key == "title" ? made_.title : made_.device) = *std::move(text);
      return {};
    }
    if (key == "first_count" || key == "expected") {
      const auto count = read_count(key, node, 1'000'000);
      if (!count) return fail(count.error());
      if (key == "expected") {
        made_.expected = static_cast<std::uint64_t>(*count);
      } else {
        made_.first_count = *count;
      }
      return {};
    }
    const auto known = read_definition_key(made_.defaults, key, node);
    if (!known) return fail(known.error());
    return *known ? Result<void>{} : unknown_key(key, node, "a template");
  }

  Result<void> read_rules(const toml::node& node) {
    const auto* array = node.as_array();
    if (array == nullptr) return fail(Errc::Syntax, "line {}: write [[line]]", line_of(node));
    if (array->size() > kMaxRules) {
      return fail(Errc::LimitExceeded, "line {}: {} [[line]]: at most {}", line_of(node),
                  array->size(), kMaxRules);
    }
    RuleReader reader(has_decimal_comma_);
    for (const auto& element : *array) {
      const auto* table = element.as_table();
      if (table == nullptr) return fail(Errc::Syntax, "line {}: write [[line]]", line_of(element));
      auto rule = reader.read(*table);
      if (!rule) return fail(rule.error());
      made_.rules.push_back(*std::move(rule));
    }
    return {};
  }

  Result<void> read_characteristics(const toml::node& node) {
    const auto* all = node.as_table();
    if (all == nullptr)
      return fail(Errc::Syntax, "line {}: write [characteristic.NAME]", line_of(node));
    if (all->size() > kMaxCharacteristics) {
      return fail(Errc::LimitExceeded, "line {}: {} characteristics: at most {}", line_of(node),
                  all->size(), kMaxCharacteristics);
    }
    for (const auto& [name, element] : *all) {
      const auto* table = element.as_table();
      if (table == nullptr || name.str().size() > kMaxName)
        return fail(Errc::Syntax, "line {}: write [characteristic.NAME]", line_of(element));
      Definition definition;
      for (const auto& [key, value] : *table) {
        if (auto done = read_characteristic_key(definition, key.str(), value); !done) return done;
      }
      if (auto good = check_definition(definition, *table); !good) return good;
      made_.characteristics.emplace(name.str(), std::move(definition));
    }
    return {};
  }

  static Result<void> read_characteristic_key(Definition& definition, std::string_view key,
                                              const toml::node& node) {
    if (key == "name") {
      auto text = read_text(key, node);
      if (!text) return fail(text.error());
      definition.name = *std::move(text);
      return {};
    }
    if (key == "required") {
      const auto flag = read_flag(key, node);
      if (!flag) return fail(flag.error());
      definition.is_required = *flag;
      return {};
    }
    const auto known = read_definition_key(definition, key, node);
    if (!known) return fail(known.error());
    return *known ? Result<void>{} : unknown_key(key, node, "a characteristic");
  }

  Result<void> read_actions(const toml::node& node) {
    const auto* table = node.as_table();
    if (table == nullptr) return fail(Errc::Syntax, "line {}: write [verdict]", line_of(node));
    for (const auto& [name, element] : *table) {
      const std::string_view key = name.str();
      if (key != "rework" && key != "scrap" && key != "unknown")
        return unknown_key(key, element, "[verdict]");
      const auto action = read_choice(key, element, kActions);
      if (!action) return fail(action.error());
      (key == "rework"  ? made_.on_rework
       : key == "scrap" ? made_.on_scrap
                        : made_.on_unknown) = static_cast<Action>(*action);
    }
    return {};
  }

  Result<void> read_sources(const toml::node& node) {
    const auto* array = node.as_array();
    if (array == nullptr || array->empty() || array->size() > kSources.size())
      return fail(Errc::Syntax, "line {}: sources must be a list of kinds", line_of(node));
    made_.sources.clear();
    for (const auto& element : *array) {
      const auto kind = read_choice("sources", element, kSources);
      if (!kind) return fail(kind.error());
      made_.sources.emplace_back(kSources.at(*kind));
    }
    return {};
  }

  bool has_decimal_comma_ = false;
  ReportTemplate made_;
};

}  // namespace

std::string_view to_string(Action action) {
  return kActions.at(static_cast<std::size_t>(action));
}

Result<ReportTemplate> read_template(std::string_view toml) {
  if (toml.size() > kMaxTemplate) {
    return fail(Errc::LimitExceeded, "template of {} bytes: at most {}", toml.size(), kMaxTemplate);
  }
  try {
    return FileReader().read(toml::parse(toml));
  } catch (const toml::parse_error& e) {
    return fail(Errc::Syntax, "line {}: {}", e.source().begin.line, e.description());
  }
}

}  // namespace dripline::report_template
