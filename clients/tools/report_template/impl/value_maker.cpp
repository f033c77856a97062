#include "clients/tools/report_template/impl/value_maker.hpp"

#include <algorithm>
#include <array>

namespace dripline::report_template {
namespace {

using measurement::ReworkSide;

/// Where limits may come from, all alike.
struct Limits {
  std::optional<double> lower, upper, tolerance, upper_deviation, lower_deviation;
  bool is_there() const {
    return lower || upper || tolerance || upper_deviation || lower_deviation;
  }
};

template <class Source>
Limits limits_of(const Source& source) {
  return {source.lower, source.upper, source.tolerance, source.upper_deviation,
          source.lower_deviation};
}

std::string unit_of(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  if (text == "in" || text == "\"") return "inch";
  return text;
}

const std::string& first_text(std::initializer_list<const std::string*> texts) {
  for (const std::string* text : texts) {
    if (!text->empty()) return *text;
  }
  return **(texts.end() - 1);
}

Result<void> set_limits(measurement::Characteristic& made, const Limits& limits) {
  const bool is_relative = limits.tolerance || limits.upper_deviation || limits.lower_deviation;
  if (is_relative && !made.nominal) {
    return fail(Errc::Conflict, "{}: a tolerance without a nominal value", made.name);
  }
  made.lower = limits.lower;
  made.upper = limits.upper;
  if (limits.tolerance) {
    made.lower = *made.nominal - *limits.tolerance;
    made.upper = *made.nominal + *limits.tolerance;
  }
  if (limits.lower_deviation) made.lower = *made.nominal + *limits.lower_deviation;
  if (limits.upper_deviation) made.upper = *made.nominal + *limits.upper_deviation;
  if (made.lower && made.upper && *made.lower > *made.upper) {
    return fail(Errc::Conflict, "{}: its lower limit {} is above its upper limit {}", made.name,
                *made.lower, *made.upper);
  }
  return {};
}

}  // namespace

Result<std::string> fill_in(const std::string& text,
                            const std::map<std::string, std::string>& fields) {
  std::string made;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const auto end = text[at] == '{' ? text.find('}', at) : std::string::npos;
    if (end == std::string::npos) {
      made += text[at];
      continue;
    }
    const std::string name = text.substr(at + 1, end - at - 1);
    const auto found = fields.find(name);
    if (found == fields.end())
      return fail(Errc::NotFound, "field {} of '{}' did not come", name, text);
    made += found->second;
    at = end;
  }
  return made;
}

Result<Value> make_value(const ReportTemplate& report_template, const LineRule& rule,
                         const ValueParts& parts) {
  static const Definition kNothing;
  const auto& all = report_template.characteristics;
  auto found = all.find(parts.name);
  if (found == all.end()) found = all.find(parts.raw);
  const Definition& own = found == all.end() ? kNothing : found->second;
  const std::array<const Definition*, 3> layers{&own, &rule.definition, &report_template.defaults};

  Value value;
  measurement::Characteristic& made = value.characteristic;
  made.name = own.name.empty() ? parts.name : own.name;
  if (made.name.empty()) return fail(Errc::Syntax, "a value without a characteristic");
  if (made.name.size() > kMaxName) {
    return fail(Errc::LimitExceeded, "characteristic of {} characters: at most {}",
                made.name.size(), kMaxName);
  }
  const LineNumbers& numbers = parts.numbers;
  made.nominal = numbers.nominal;
  Limits limits = limits_of(numbers);
  std::optional<ReworkSide> rework;
  std::optional<std::uint8_t> decimals;
  for (const Definition* layer : layers) {
    if (!made.nominal) made.nominal = layer->nominal;
    if (!limits.is_there()) limits = limits_of(*layer);
    if (!rework) rework = layer->rework;
    if (!decimals) decimals = layer->decimals;
  }
  static const std::string kMillimeter = "mm";
  made.unit = unit_of(first_text({&parts.unit, &own.unit, &rule.definition.unit,
                                  &report_template.defaults.unit, &kMillimeter}));
  made.decimals = decimals.value_or(numbers.decimals);
  value.tool =
      first_text({&parts.tool, &own.tool, &rule.definition.tool, &report_template.defaults.tool});
  if (auto set = set_limits(made, limits); !set) return fail(set.error());
  if (numbers.actual) {
    value.actual = *numbers.actual;
  } else if (numbers.deviation && made.nominal) {
    value.actual = *made.nominal + *numbers.deviation;
  } else {
    return fail(Errc::Syntax, "{}: a deviation without a nominal value", made.name);
  }
  value.verdict = measurement::judge(made, value.actual, rework.value_or(ReworkSide::None));
  return value;
}

}  // namespace dripline::report_template
