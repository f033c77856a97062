#include "protocol/process/settings_reader.hpp"

#include <toml++/toml.h>
#include <algorithm>
#include <charconv>
#include <CLI/CLI.hpp>
#include <fstream>
#include <sstream>

namespace dripline::process {
namespace {

/// ["baud=9600", "parity=even"]: one entry a line.
Result<std::string> list_text(const toml::array& list) {
  std::string lines;
  for (const toml::node& entry : list) {
    const auto* text = entry.as_string();
    if (text == nullptr) return fail(Errc::Syntax, "must be a list of strings");
    lines += text->get() + "\n";
  }
  return lines;
}

Result<std::string> value_text(const toml::node& node, Written written) {
  const auto* text = node.as_string();
  const auto* number = node.as_integer();
  const auto* list = node.as_array();
  switch (written) {
    case Written::Text:
      if (text != nullptr) return text->get();
      return fail(Errc::Syntax, "must be a string, not {}",
                  list != nullptr ? "a list" : "another type");
    case Written::Number:
      if (number != nullptr) return std::to_string(number->get());
      return fail(Errc::Syntax, "must be a whole number");
    case Written::TextOrNumber:
      if (text != nullptr) return text->get();
      if (number != nullptr) return std::to_string(number->get());
      return fail(Errc::Syntax, "must be a string or a whole number");
    case Written::List:
      if (text != nullptr) return text->get();
      if (list != nullptr) return list_text(*list);
      return fail(Errc::Syntax, "must be a string or a list of strings");
  }
  return fail(Errc::Syntax, "cannot be read");
}

}  // namespace

namespace detail {

std::string shown(const std::string& value) {
  return value;
}
std::string shown(const std::filesystem::path& value) {
  return value.string();
}
std::string shown(bool value) {
  return value ? "yes" : "no";
}
std::string shown(std::uint64_t value) {
  return std::to_string(value);
}

}  // namespace detail

Result<std::uint64_t> parse_number(std::string_view text, std::uint64_t lowest,
                                   std::uint64_t highest) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    return fail(Errc::Syntax, "'{}' is not a whole number from {} to {}", text, lowest, highest);
  if (value < lowest || value > highest)
    return fail(Errc::LimitExceeded, "{} is not from {} to {}", value, lowest, highest);
  return value;
}

Result<bool> parse_yes_no(std::string_view text) {
  if (text != "yes" && text != "no") return fail(Errc::Syntax, "'{}' is neither yes nor no", text);
  return text == "yes";
}

Result<void> SettingsReader::read_toml(std::string_view text, Others others) const {
  toml::table table;
  try {
    table = toml::parse(text);
  } catch (const toml::parse_error& error) {
    return fail(Errc::Syntax, "line {}: {}", error.source().begin.line, error.description());
  }
  for (const auto& [key, node] : table) {
    const std::string_view name = key.str();
    const auto line = node.source().begin.line;
    const auto found = std::ranges::find(settings_, name, &Setting::key);
    if (found == settings_.end()) {
      if (std::ranges::find(others, name) != others.end()) continue;
      return fail(Errc::Syntax, "line {}: key '{}' is not known", line, name);
    }
    const auto value = value_text(node, found->written);
    if (!value) return fail(value.error().code, "line {}: {} {}", line, name, value.error().what);
    if (const auto done = found->set(*value); !done)
      return fail(done.error().code, "line {}: {}: {}", line, name, done.error().what);
  }
  return {};
}

Result<void> SettingsReader::read_file(const std::filesystem::path& path, Others others) const {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()))
    return fail(Errc::NotFound, "configuration file '{}' cannot be read", path.string());
  if (const auto done = read_toml(text.str(), others); !done)
    return fail(done.error().code, "{}: {}", path.string(), done.error().what);
  return {};
}

void SettingsReader::declare(CLI::App& app) {
  for (const Setting& setting : settings_) {
    std::string fallback = setting.fallback;
    if (!fallback.empty() && !setting.unit.empty()) fallback += " " + std::string(setting.unit);
    if (!fallback.empty()) fallback = fmt::format(" [{}]", fallback);
    auto* option = app.add_option_function<std::string>(
        "--" + std::string(setting.key),
        [this, &setting](const std::string& value) { given_.emplace_back(&setting, value); },
        std::string(setting.text) + fallback);
    option->type_name(std::string(setting.type));
    if (setting.written == Written::List) option->join('\n');
  }
}

Result<void> SettingsReader::apply_command_line() const {
  for (const auto& [setting, value] : given_) {
    if (const auto done = setting->set(value); !done)
      return fail(done.error().code, "--{}: {}", setting->key, done.error().what);
  }
  return {};
}

}  // namespace dripline::process
