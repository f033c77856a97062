#include "server/app/port_table.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace dripline::app {
namespace {

unsigned line_of(const toml::node& node) {
  return node.source().begin.line;
}

struct TextKey {
  std::string_view key;
  std::string storage::Port::*member;
};
constexpr std::array kTextKeys{
    TextKey{"name", &storage::Port::name},       TextKey{"machine", &storage::Port::machine},
    TextKey{"address", &storage::Port::address}, TextKey{"template", &storage::Port::line_template},
    TextKey{"rules", &storage::Port::rules},
};

/// As the words of a line's settings are written.
Result<std::string> scalar_text(std::string_view key, const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* flag = node.as_boolean()) return std::string(flag->get() ? "yes" : "no");
  return fail(Errc::Syntax, "line {}: {} must be a string, a number, true or false", line_of(node),
              key);
}

Result<std::string> read_rules_file(const toml::node& node, const std::string& folder) {
  const auto* name = node.as_string();
  if (name == nullptr) {
    return fail(Errc::Syntax, "line {}: rules_file must be a string", line_of(node));
  }
  const auto path = std::filesystem::path(folder) / name->get();
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return fail(Errc::NotFound, "line {}: rules_file '{}' cannot be read", line_of(node),
                path.string());
  }
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

Result<void> read_key(storage::Port& port, std::string_view key, const toml::node& node,
                      const std::string& folder) {
  if (key == "rules_file") {
    auto rules = read_rules_file(node, folder);
    if (!rules) return fail(rules.error());
    port.rules = *std::move(rules);
    return {};
  }
  if (key == "enabled") {
    if (!node.is_boolean()) {
      return fail(Errc::Syntax, "line {}: enabled must be true or false", line_of(node));
    }
    port.is_enabled = node.as_boolean()->get();
    return {};
  }
  auto text = scalar_text(key, node);
  if (!text) return fail(text.error());
  for (const auto& row : kTextKeys) {
    if (row.key != key) continue;
    if (!node.is_string()) {
      return fail(Errc::Syntax, "line {}: {} must be a string", line_of(node), key);
    }
    port.*row.member = *std::move(text);
    return {};
  }
  port.settings.emplace_back(key, *std::move(text));
  return {};
}

Result<storage::Port> read_port(const toml::table& table, const std::string& folder) {
  storage::Port port;
  for (const auto& [key, node] : table) {
    if (auto read = read_key(port, key.str(), node, folder); !read) return fail(read.error());
  }
  if (port.machine.empty() || port.address.empty()) {
    return fail(Errc::Syntax, "line {}: a port needs a machine and an address", line_of(table));
  }
  if (port.name.empty()) port.name = port.machine;
  // A table has no order: baud and the like change the values of the short form.
  std::stable_partition(port.settings.begin(), port.settings.end(),
                        [](const auto& setting) { return setting.first == "line"; });
  return port;
}

}  // namespace

Result<std::vector<storage::Port>> read_ports(const toml::node& node, const std::string& folder) {
  const auto* array = node.as_array();
  if (array == nullptr) return fail(Errc::Syntax, "line {}: write [[port]]", line_of(node));
  std::vector<storage::Port> ports;
  for (const auto& element : *array) {
    if (!element.is_table()) return fail(Errc::Syntax, "line {}: write [[port]]", line_of(element));
    auto port = read_port(*element.as_table(), folder);
    if (!port) return fail(port.error());
    ports.push_back(*std::move(port));
  }
  return ports;
}

}  // namespace dripline::app
