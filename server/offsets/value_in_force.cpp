#include "server/offsets/value_in_force.hpp"

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <vector>

#include "gateway/interpreter/registry.hpp"
#include "protocol/base/units.hpp"
#include "server/offsets/offset_rule.hpp"

namespace dripline::offsets {
namespace {

using Kind = SetupTarget::Kind;

constexpr std::uint64_t kSetupsBack = 200;  ///< that are looked through

bool is_of_tool(const SetupTarget& target) {
  return target.kind == Kind::Tool || target.kind == Kind::Wear;
}

/// R is the cutter itself. The nose of a lathe's tool moves its edge along X and Z, the
/// radius of a mill's along X and Y.
std::string_view axes_of(const SetupTarget& target, bool is_mill) {
  if (!is_of_tool(target) || target.key == "X" || target.key == "Z") return target.key;
  if (target.key == "length") return "Z";
  return is_mill ? "XYR" : "XZR";
}

bool is_mill(std::string_view control) {
  const auto dialect = interpreter::find_dialect(control);
  return dialect && (*dialect)->machine == interpreter::MachineKind::Mill;
}

struct Number {
  SetupTarget target;
  double value = 0;
};
using Numbers = std::map<std::string, Number>;  // by their names

struct Values {
  Numbers numbers;
  std::string unit, options;
};

void add_numbers(const toml::table& table, const SetupTarget& owner, const std::string& prefix,
                 Numbers& numbers) {
  for (const auto& [key, node] : table) {
    SetupTarget target = owner;
    target.key = key.str();
    if (target.key == "number" || target.key == "pocket") continue;
    if (const auto* wear = node.as_table(); wear != nullptr && target.key == "wear") {
      target.kind = Kind::Wear;
      add_numbers(*wear, target, prefix + ".wear", numbers);
    } else if (const auto value = node.is_number() ? node.value<double>() : std::nullopt) {
      numbers[prefix + "." + target.key] = {target, *value};
    }
  }
}

void add_entry(const toml::table& entry, Kind kind, Numbers& numbers) {
  SetupTarget owner;
  owner.kind = kind;
  if (kind == Kind::Tool) {
    owner.tool = static_cast<int>(entry["number"].value_or<std::int64_t>(0));
    return add_numbers(entry, owner, fmt::format("T{}", owner.tool), numbers);
  }
  owner.name = entry["name"].value_or<std::string>("");
  if (kind == Kind::Offset) return add_numbers(entry, owner, owner.name, numbers);
  numbers["variable " + owner.name] = {owner, entry["value"].value_or<double>(0)};
}

Result<Values> values_of(const std::string& text, const std::string& control) {
  Values values;
  auto unit = unit_in_force(text, control);
  if (!unit) return fail(unit.error());
  values.unit = *std::move(unit);
  const auto setup = toml::parse(text);  // unit_in_force has parsed it already
  const auto each = [&](const char* list, Kind kind) {
    const auto* array = setup.get_as<toml::array>(list);
    if (array == nullptr) return;
    for (const toml::node& node : *array) {
      if (const auto* table = node.as_table()) add_entry(*table, kind, values.numbers);
    }
  };
  each("tool", Kind::Tool);
  each("offset", Kind::Offset);
  each("variable", Kind::Variable);
  if (const auto* options = setup.get_as<toml::table>("control")) {
    std::ostringstream out;
    out << *options;
    values.options = std::move(out).str();
  }
  return values;
}

/// Whose values count for a target.
struct Scope {
  SetupTarget target;
  std::string tool;  ///< bare; empty: any
  bool is_mill = false;

  bool has(const SetupTarget& value) const {
    if (value.kind == Kind::Variable || target.kind == Kind::Variable) return true;
    if (is_of_tool(value) && is_of_tool(target) && value.tool != target.tool) return false;
    if (is_of_tool(value) && !is_of_tool(target) && !tool.empty() &&
        fmt::to_string(value.tool) != tool) {
      return false;
    }
    const auto mine = axes_of(target, is_mill);
    return axes_of(value, is_mill).find_first_of(mine) != std::string_view::npos;
  }
};

std::string number_words(const Values& values, const std::string& name) {
  const auto found = values.numbers.find(name);
  if (found == values.numbers.end()) return "not given";
  const auto& target = found->second.target;
  const bool is_length = canonical(target, 1, "in") != 1;
  return fmt::format("{}{}{}", found->second.value, is_length ? " " : "",
                     is_length ? values.unit : "");
}

/// A tool's value or an offset that is not given is 0; a variable is then the control's own.
bool is_unchanged(const Values& before, const Values& now, const std::string& name) {
  const auto old = before.numbers.find(name), other = now.numbers.find(name);
  const bool has_old = old != before.numbers.end(), has_other = other != now.numbers.end();
  const auto& target = has_old ? old->second.target : other->second.target;
  if (target.kind == Kind::Variable && has_old != has_other) return false;
  const double a = has_old ? canonical(target, old->second.value, before.unit) : 0;
  const double b = has_other ? canonical(target, other->second.value, now.unit) : 0;
  return is_same_number(a, b);
}

/// What was another one; empty: nothing.
std::string difference(const Values& before, const Values& now, const Scope& scope) {
  for (const Values* all : {&now, &before}) {
    for (const auto& [name, number] : all->numbers) {
      if (scope.has(number.target) && !is_unchanged(before, now, name))
        return fmt::format("{} was {}", name, number_words(before, name));
    }
  }
  return before.options == now.options ? "" : "[control] was another one";
}

}  // namespace

bool is_same_number(double a, double b) {
  constexpr double kLastDigits = 1e-9;
  return std::abs(a - b) <= kLastDigits * std::max({1.0, std::abs(a), std::abs(b)});
}

bool is_angle(const SetupTarget& target) {
  return target.key == "A" || target.key == "B" || target.key == "C";
}

double canonical(const SetupTarget& target, double value, std::string_view unit) {
  const bool is_length = target.kind != Kind::Variable && target.key != "tip" && !is_angle(target);
  return is_length && unit == "in" ? value * Length::kMillimetersPerInch : value;
}

bool moves_the_same(const SetupTarget& a, const SetupTarget& b, std::string_view control) {
  return Scope{.target = a, .tool = {}, .is_mill = is_mill(control)}.has(b);
}

Result<InForceSince> in_force_since(storage::SetupStore& setups, const SetupInForce& now,
                                    const SetupTarget& target, std::string_view tool) {
  InForceSince since{.setup = now.number, .change = {}};
  if (now.number == 0) return since;
  const auto values = values_of(now.text, now.control);
  if (!values) return fail(values.error());
  Scope scope{.target = target, .tool = bare_tool(tool), .is_mill = is_mill(now.control)};
  if (scope.tool.find_first_not_of("0123456789") != std::string::npos) scope.tool.clear();
  for (std::uint64_t back = 0; since.setup > 1 && back < kSetupsBack; ++back) {
    const auto before = setups.find(now.machine, since.setup - 1);
    if (!before) return fail(before.error());
    const auto old = values_of(before->text, now.control);
    since.change = old ? difference(*old, *values, scope) : old.error().what;
    if (!since.change.empty()) return since;
    --since.setup;
  }
  return since;
}

}  // namespace dripline::offsets
