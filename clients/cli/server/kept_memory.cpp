#include "clients/cli/server/kept_memory.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include "clients/cli/setup/setup_changes.hpp"

namespace dripline::cli {
KeptMemory cells_of(const client::Memory& memory) {
  KeptMemory cells;
  for (const auto& cell : memory.cells) cells[cell.name] = {cell.value, cell.setup};
  return cells;
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
    return fail(Errc::Syntax, "the variables cannot be added to this setup: line {}: {}",
                error.source().begin.line, error.description());
  }
  return text;
}

}  // namespace dripline::cli
