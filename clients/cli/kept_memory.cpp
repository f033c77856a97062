#include "clients/cli/kept_memory.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "clients/cli/setup_edit.hpp"

namespace dripline::cli {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxText = 4096;  ///< of a record

/// A number or null.
bool read_number(const Json& json, std::optional<double>& number) {
  if (json.is_null()) return true;
  if (!json.is_number()) return false;
  number = json.get<double>();
  return std::isfinite(*number);
}

/// A name as controls have them: P10, #500, G54.1P7.X
bool is_cell_name(std::string_view name) {
  if (name.empty() || name.size() > 64) return false;
  return name.find_first_not_of(
             "#.0123456789_ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz") ==
         std::string_view::npos;
}

}  // namespace

Result<void> add_memory_text(std::string_view text, KeptMemory& memory) {
  if (text.size() > kMaxText)
    return fail(Errc::LimitExceeded, "a memory text of {} bytes, at most {}", text.size(),
                kMaxText);
  // Ours nests three deep; brackets within names do not occur.
  int depth = 0;
  for (const char c : text) {
    if (c == '[' || c == '{') ++depth;
    if (depth > 8) return fail(Errc::Syntax, "a memory text is nested too deeply");
    if (c == ']' || c == '}') --depth;
  }
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("cells") || !json["cells"].is_object())
    return fail(Errc::Syntax, "a memory text without cells");
  for (const auto& [name, pair] : json["cells"].items()) {
    KeptCell cell;
    const bool is_good = is_cell_name(name) && pair.is_array() && pair.size() == 2 &&
                         read_number(pair[0], cell.value) && read_number(pair[1], cell.base);
    if (!is_good) return fail(Errc::Syntax, "a memory text with a cell that is none");
    memory[name] = cell;
  }
  return {};
}

KeptMemory filtered(const KeptMemory& memory, std::string_view filter) {
  KeptMemory found;
  for (const auto& [name, cell] : memory) {
    if (name.find(filter) != std::string::npos) found[name] = cell;
  }
  return found;
}

Result<std::string> with_variables(std::string_view setup,
                                   const std::map<std::string, double>& variables) {
  std::vector<SetupChange> changes;
  std::map<std::string, double> left = variables;
  try {
    const toml::table table = toml::parse(setup);
    const auto* known = table["variable"].as_array();
    for (std::size_t i = 0; known != nullptr && i < known->size(); ++i) {
      const auto* row = (*known)[i].as_table();
      const std::string name = row == nullptr ? "" : (*row)["name"].value_or(std::string());
      const auto found = left.find(name);
      if (found == left.end()) continue;
      changes.push_back({fmt::format("variable[{}].value", i), fmt::format("{}", found->second)});
      left.erase(found);
    }
  } catch (const toml::parse_error& error) {
    return fail(Errc::Syntax, "line {}: {}", error.source().begin.line, error.description());
  }
  auto text = with_numbers(setup, changes);
  if (!text) return text;
  if (!left.empty() && !text->empty() && text->back() != '\n') *text += '\n';
  for (const auto& [name, value] : left)
    *text += fmt::format("\n[[variable]]\nname = \"{}\"\nvalue = {}\n", name, value);
  try {
    (void)toml::parse(*text);
  } catch (const toml::parse_error& error) {
    return fail(Errc::Syntax, "the variables can not be added to this setup: line {}: {}",
                error.source().begin.line, error.description());
  }
  return text;
}

}  // namespace dripline::cli
