#include "clients/cli/port/port_file.hpp"

#include <toml++/toml.h>
#include <filesystem>

#include "clients/cli/offline/mapped_file.hpp"

namespace dripline::cli {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kMaxPortFile = 1024 * 1024;

/// Says where in the file something is wrong.
struct FilePlace {
  const std::string& file;
  const toml::node& node;
};

tl::unexpected<Error> wrong(const FilePlace& place, std::string_view what) {
  return fail(Errc::Syntax, "{} line {}: {}", place.file, place.node.source().begin.line, what);
}

Result<std::string> text_of(const FilePlace& place, std::string_view key) {
  if (const auto* text = place.node.as_string()) return text->get();
  return wrong(place, fmt::format("{} must be a string", key));
}

Result<std::string> value_of(const FilePlace& place, std::string_view key) {
  if (const auto* text = place.node.as_string()) return text->get();
  if (const auto* number = place.node.as_integer()) return std::to_string(number->get());
  if (const auto* number = place.node.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* flag = place.node.as_boolean()) return flag->get() ? "yes" : "no";
  return wrong(place, fmt::format("{} must be a string, a number, true or false", key));
}

Result<void> read_rules(client::PortRequest& port, const FilePlace& place) {
  const auto name = text_of(place, "rules_file");
  if (!name) return fail(name.error());
  auto rules =
      read_small_file((fs::path(place.file).parent_path() / *name).string(), kMaxRulesFile);
  if (!rules) return fail(rules.error());
  port.rules = *std::move(rules);
  return {};
}

/// The texts of a port; every other key is a setting of its line.
std::string* member_of(client::PortRequest& port, std::string_view key) {
  if (key == "name") return &port.name;
  if (key == "machine") return &port.machine;
  if (key == "address") return &port.address;
  if (key == "template") return &port.line_template;
  if (key == "rules") return &port.rules;
  return nullptr;
}

Result<void> read_key(client::PortRequest& port, std::string_view key, const FilePlace& place) {
  if (key == "rules_file") return read_rules(port, place);
  if (key == "enabled") {
    const auto* flag = place.node.as_boolean();
    if (flag == nullptr) return wrong(place, "enabled must be true or false");
    port.enabled = flag->get();
    return {};
  }
  std::string* member = member_of(port, key);
  auto text = member != nullptr ? text_of(place, key) : value_of(place, key);
  if (!text) return fail(text.error());
  (member != nullptr ? *member : port.settings[std::string(key)]) = *std::move(text);
  return {};
}

Result<client::PortRequest> read_port(const FilePlace& place) {
  const auto* table = place.node.as_table();
  if (table == nullptr) return wrong(place, "write [[port]]");
  client::PortRequest port;
  for (const auto& [key, node] : *table) {
    if (auto read = read_key(port, key.str(), {place.file, node}); !read) return fail(read.error());
  }
  if (port.machine.empty() || port.address.empty()) {
    return wrong(place, "a port needs a machine and an address");
  }
  if (port.name.empty()) port.name = port.machine;
  return port;
}

Result<toml::table> parse(const std::string& path, const std::string& text) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& e) {
    return fail(Errc::Syntax, "{} line {}: {}", path, e.source().begin.line, e.description());
  }
}

}  // namespace

Result<std::string> read_small_file(const std::string& path, std::size_t limit) {
  const auto file = MappedFile::open(path);
  if (!file) return fail(file.error());
  if (file->text().size() > limit) {
    return fail(Errc::LimitExceeded, "{} has {} bytes: at most {}", path, file->text().size(),
                limit);
  }
  return std::string(file->text());
}

Result<std::vector<client::PortRequest>> read_port_file(const std::string& path) {
  const auto text = read_small_file(path, kMaxPortFile);
  if (!text) return fail(text.error());
  const auto table = parse(path, *text);
  if (!table) return fail(table.error());
  std::vector<client::PortRequest> ports;
  for (const auto& [key, node] : *table) {
    const FilePlace place{path, node};
    if (key.str() != "port" || !node.is_array()) {
      return wrong(place, fmt::format("'{}' is not known here: write [[port]]", key.str()));
    }
    for (const auto& element : *node.as_array()) {
      auto port = read_port({path, element});
      if (!port) return fail(port.error());
      ports.push_back(*std::move(port));
    }
  }
  if (ports.empty()) return fail(Errc::Syntax, "{} has no [[port]]", path);
  return ports;
}

namespace {

/// The short form gives all four, so no setting of the port may override it.
void set_line(client::Settings& settings, std::string_view value) {
  for (const char* part : {"baud", "parity", "data_bits", "stop_bits"}) settings.erase(part);
  settings["line"] = std::string(value);
}

}  // namespace

Result<void> apply_setting(client::Settings& settings, std::string_view text) {
  const auto equals = text.find('=');
  if (equals == 0) return fail(Errc::Syntax, "'{}' has no key before its =", text);
  if (equals == std::string_view::npos) {
    const bool is_short_form = !text.empty() && text.front() >= '0' && text.front() <= '9';
    if (!is_short_form) {
      return fail(Errc::Syntax, "'{}' is neither KEY=VALUE nor a line such as 9600e72", text);
    }
    set_line(settings, text);
    return {};
  }
  const std::string key(text.substr(0, equals));
  const std::string_view value = text.substr(equals + 1);
  if (value.empty()) {
    settings.erase(key);
  } else if (key == "line") {
    set_line(settings, value);
  } else {
    settings[key] = std::string(value);
  }
  return {};
}

}  // namespace dripline::cli
