#include "server/offsets/setup_value.hpp"

#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "gateway/interpreter/registry.hpp"

namespace dripline::offsets {
namespace {

using Kind = SetupTarget::Kind;

constexpr std::array<std::string_view, 9> kAxes{"X", "Y", "Z", "A", "B", "C", "U", "V", "W"};
constexpr std::array<std::string_view, 4> kToolKeys{"X", "Z", "length", "radius"};
constexpr std::array<std::string_view, 3> kWearKeys{"X", "Z", "radius"};

template <class List>
bool holds(const List& list, std::string_view key) {
  return std::ranges::find(list, key) != list.end();
}

Result<toml::table> parse(std::string_view text) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& unread) {  // what the library reports with
    return fail(Errc::Syntax, "setup, line {}: {}", unread.source().begin.line,
                unread.description());
  }
}

/// The table of a tool, an offset or a variable; null: there is none.
const toml::table* entry_of(const toml::table& setup, const SetupTarget& target) {
  const bool is_tool = target.kind == Kind::Tool || target.kind == Kind::Wear;
  const auto* list = setup.get_as<toml::array>(is_tool                       ? "tool"
                                               : target.kind == Kind::Offset ? "offset"
                                                                             : "variable");
  if (list == nullptr) return nullptr;
  for (const toml::node& node : *list) {
    const auto* table = node.as_table();
    if (table == nullptr) continue;
    if (is_tool ? (*table)["number"].value<std::int64_t>() == target.tool
                : (*table)["name"].value<std::string>() == target.name) {
      return table;
    }
  }
  return nullptr;
}

std::string key_of(const SetupTarget& target) {
  return target.kind == Kind::Variable ? "value" : target.key;
}

/// Where the value is, or would be; null: nowhere yet.
const toml::table* holder_of(const toml::table& setup, const SetupTarget& target) {
  const auto* entry = entry_of(setup, target);
  return entry != nullptr && target.kind == Kind::Wear ? entry->get_as<toml::table>("wear") : entry;
}

/// Offsets in the text of the source positions that the parser notes; they count characters, not
/// bytes.
std::size_t place_of(std::string_view text, const toml::source_position& position) {
  std::size_t at = 0;
  for (toml::source_index line = 1; line < position.line; ++line) at = text.find('\n', at) + 1;
  for (toml::source_index column = 1; column < position.column && at < text.size(); ++column) {
    ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80) ++at;
  }
  return at;
}

/// From the node's beginning to the end of its characters.
std::pair<std::size_t, std::size_t> extent_of(std::string_view text, const toml::node& node) {
  constexpr std::string_view kEnd = ",]}#\r\n\t ";
  const std::size_t begin = place_of(text, node.source().begin);
  std::size_t end = text.find_first_of(kEnd, begin);
  if (end == std::string_view::npos) end = text.size();
  return {begin, end};
}

std::string number_text(double value, int decimals) {
  std::string text =
      fmt::format("{:.{}f}", value, std::max(1, decimals));  // TOML's numbers keep their kind
  while (text.ends_with('0') && text[text.size() - 2] != '.') text.pop_back();
  return text == "-0.0" ? "0.0" : text;
}

/// Adds `words` after the entry's first value: on a line of its own, or after a comma in a table
/// within braces.
std::optional<std::string> with_words(std::string_view text, const toml::table& entry,
                                      const std::string& words) {
  const char* first = entry.contains("number") ? "number" : "name";
  const auto* node = entry.get(first);
  if (node == nullptr) return std::nullopt;
  std::size_t end = extent_of(text, *node).second;
  if (node->is_string()) {  // a name may hold anything: go past its closing quote
    const std::size_t begin = place_of(text, node->source().begin);
    end = text.find(text[begin], begin + 1);
    if (end == std::string_view::npos) return std::nullopt;
    ++end;
  }
  std::string changed(text);
  if (entry.is_inline()) {
    changed.insert(end, ", " + words);
  } else {
    const std::size_t line_end = std::min(text.find('\n', end), text.size());
    changed.insert(line_end, "\n" + words);
  }
  return changed;
}

std::string new_entry(const SetupTarget& target, const std::string& number) {
  switch (target.kind) {
    case Kind::Wear:
      return fmt::format("[[tool]]\nnumber = {}\nwear = {{ {} = {} }}\n", target.tool, target.key,
                         number);
    case Kind::Tool:
      return fmt::format("[[tool]]\nnumber = {}\n{} = {}\n", target.tool, target.key, number);
    case Kind::Offset:
      return fmt::format("[[offset]]\nname = \"{}\"\n{} = {}\n", target.name, target.key, number);
    default:
      return fmt::format("[[variable]]\nname = \"{}\"\nvalue = {}\n", target.name, number);
  }
}

/// Another value in a place that is there.
std::string replaced(std::string_view text, const toml::node& node, const std::string& number) {
  const auto [begin, end] = extent_of(text, node);
  return std::string(text.substr(0, begin)) + number + std::string(text.substr(end));
}

std::optional<std::string> changed_text(std::string_view text, const toml::table& setup,
                                        const SetupTarget& target, const std::string& number) {
  const auto* entry = entry_of(setup, target);
  if (entry == nullptr) {
    std::string added(text);
    if (!added.empty() && !added.ends_with('\n')) added += '\n';
    return added + (added.empty() ? "" : "\n") + new_entry(target, number);
  }
  const auto* holder = holder_of(setup, target);
  if (holder == nullptr)
    return with_words(text, *entry, fmt::format("wear = {{ {} = {} }}", target.key, number));
  if (const auto* node = holder->get(key_of(target))) return replaced(text, *node, number);
  if (target.kind != Kind::Wear)
    return with_words(text, *entry, fmt::format("{} = {}", target.key, number));
  if (!holder->is_inline()) return std::nullopt;
  const std::size_t brace = place_of(text, holder->source().begin);
  if (brace >= text.size() || text[brace] != '{') return std::nullopt;
  std::string changed(text);
  changed.insert(brace + 1,
                 fmt::format(" {} = {}{}", target.key, number, holder->empty() ? "" : ","));
  return changed;
}

void add_values(const toml::table& table, const std::string& prefix,
                std::vector<NamedValue>& values) {
  for (const auto& [key, node] : table) {
    if (key.str() == "number" || key.str() == "tip" || key.str() == "pocket") continue;
    if (const auto value = node.is_number() ? node.value<double>() : std::nullopt)
      values.push_back({prefix + "." + std::string(key.str()), *value});
    if (key.str() == "wear" && node.is_table())
      add_values(*node.as_table(), prefix + ".wear", values);
  }
}

}  // namespace

Result<SetupTarget> parse_setup_target(std::string_view text) {
  SetupTarget target;
  const auto point = text.rfind('.');
  const auto refuse = [&] {
    return fail(Errc::Syntax,
                "target '{}': T3.wear.X, T3.length, G54.Z or a variable such as #500 is expected",
                text);
  };
  if (text.empty() || text.find_first_of("\"\\\n\r ") != std::string_view::npos) return refuse();
  if (point == std::string_view::npos) {
    target.name = text;
    return target;
  }
  target.key = text.substr(point + 1);
  std::string_view owner = text.substr(0, point);
  const bool is_tool =
      owner.size() > 1 && owner.front() == 'T' && owner[1] >= '0' && owner[1] <= '9';
  if (!is_tool) {
    target.kind = Kind::Offset;
    target.name = owner;
    return holds(kAxes, target.key) && !owner.empty() ? Result<SetupTarget>(target) : refuse();
  }
  target.kind = owner.ends_with(".wear") ? Kind::Wear : Kind::Tool;
  if (target.kind == Kind::Wear) owner.remove_suffix(5);
  owner.remove_prefix(1);
  const auto [end, error] = std::from_chars(owner.data(), owner.data() + owner.size(), target.tool);
  const bool is_known =
      target.kind == Kind::Wear ? holds(kWearKeys, target.key) : holds(kToolKeys, target.key);
  if (error != std::errc() || end != owner.data() + owner.size() || target.tool < 1 || !is_known)
    return refuse();
  return target;
}

Result<double> value_in_setup(std::string_view text, const SetupTarget& target) {
  const auto setup = parse(text);
  if (!setup) return fail(setup.error());
  const auto* holder = holder_of(*setup, target);
  if (holder == nullptr) return 0.0;
  return (*holder)[key_of(target)].value<double>().value_or(0.0);
}

Result<bool> is_in_setup(std::string_view text, const SetupTarget& target) {
  const auto setup = parse(text);
  if (!setup) return fail(setup.error());
  return entry_of(*setup, target) != nullptr;
}

std::string owner_of(const SetupTarget& target) {
  if (target.kind == Kind::Variable) return "variable " + target.name;
  if (target.kind == Kind::Offset) return "offset " + target.name;
  return fmt::format("tool {}", target.tool);
}

Result<std::string> with_value(std::string_view text, const SetupTarget& target, double value,
                               int decimals) {
  const auto setup = parse(text);
  if (!setup) return fail(setup.error());
  const std::string number = number_text(value, decimals);
  auto changed = changed_text(text, *setup, target, number);
  const auto refuse = [&] {
    return fail(Errc::Unsupported,
                "the setup's layout has no place for this value; write it once by hand");
  };
  if (!changed) return refuse();
  const auto again = value_in_setup(*changed, target);
  double written = 0;
  std::from_chars(number.data(), number.data() + number.size(), written);
  if (!again || *again != written) return refuse();
  return *std::move(changed);
}

Result<std::vector<NamedValue>> values_in_setup(std::string_view text) {
  const auto setup = parse(text);
  if (!setup) return fail(setup.error());
  std::vector<NamedValue> values;
  const auto each = [&](const char* list, auto prefix_of) {
    const auto* array = setup->get_as<toml::array>(list);
    if (array == nullptr) return;
    for (const toml::node& node : *array) {
      if (const auto* table = node.as_table()) add_values(*table, prefix_of(*table), values);
    }
  };
  each("tool", [](const toml::table& tool) {
    return fmt::format("T{}", tool["number"].value_or<std::int64_t>(0));
  });
  each("offset",
       [](const toml::table& offset) { return offset["name"].value_or<std::string>(""); });
  return values;
}

/// deploy/docs/setup-format.md: X of a lathe is a radius, unless a Centurion's `stored_x` says
/// otherwise of offsets.
Result<std::string> kind_of_x(std::string_view text, std::string_view control,
                              const SetupTarget& target) {
  if (target.key == "radius") return std::string("radius");
  const auto dialect = interpreter::find_dialect(control);
  const bool is_lathe = dialect && (*dialect)->machine == interpreter::MachineKind::Lathe;
  if (!is_lathe || target.key != "X") return std::string();
  const auto setup = parse(text);
  if (!setup) return fail(setup.error());
  const bool is_diameter = target.kind == Kind::Offset &&
                           (*setup)["control"]["stored_x"].value<std::string>() == "diameter";
  return std::string(is_diameter ? "diameter" : "radius");
}

Result<std::string> unit_of_setup(std::string_view text) {
  const auto setup = parse(text);
  if (!setup) return fail(setup.error());
  return (*setup)["units"].value_or<std::string>("");
}

Result<std::string> unit_in_force(std::string_view text, std::string_view control) {
  auto stated = unit_of_setup(text);
  if (!stated || !stated->empty()) return stated;
  const auto dialect = interpreter::find_dialect(control);
  if (!dialect) return fail(dialect.error());
  return std::string((*dialect)->units == interpreter::Units::Inch ? "in" : "mm");
}

}  // namespace dripline::offsets
