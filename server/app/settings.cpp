#include "server/app/settings.hpp"

#include <toml++/toml.h>
#include <unistd.h>
#include <array>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "protocol/base/state_location.hpp"
#include "server/app/port_table.hpp"

namespace dripline::app {
namespace {

constexpr std::uint32_t kLongestMs = 600'000;
constexpr std::uint32_t kMaxConnections = 800;  ///< DDS waits with select(): below 1,000 files

constexpr std::array kRows{
    SettingRow{"state", &Settings::state, "DIR", 0, 0,
               "folder of the database, the token and dncd.json"},
    SettingRow{"http", &Settings::http, "HOST:PORT", 0, 0,
               "where the REST API listens; port 0 takes a free one"},
    SettingRow{"tls-certificate", &Settings::tls_certificate, "FILE", 0, 0,
               "certificate chain (PEM); needed to listen beyond this machine"},
    SettingRow{"tls-key", &Settings::tls_key, "FILE", 0, 0, "private key of the certificate (PEM)"},
    SettingRow{"http-connections", &Settings::http_connections, "NUMBER", 16, kMaxConnections,
               "connections to the REST API at once; the longest silent one makes room"},
    SettingRow{"http-connections-per-address", &Settings::http_connections_per_address, "NUMBER", 4,
               kMaxConnections, "of these from one address; give more to a proxy in front"},
    SettingRow{"http-event-streams", &Settings::http_event_streams, "NUMBER", 1, kMaxConnections,
               "event streams at once; at most half of the connections"},
    SettingRow{"dds-domain", &Settings::dds_domain, "NUMBER", 0, 230, "DDS domain"},
    SettingRow{"dds-tag", &Settings::dds_tag, "TEXT", 0, 0,
               "systems with different tags do not see each other"},
    SettingRow{"dds-interface", &Settings::dds_interface, "NAME", 0, 0,
               "network interface or address where the gateways are"},
    SettingRow{"dds-open-network", &Settings::dds_open_network, "yes|no", 0, 0,
               "yes: DDS beyond this machine although it has no authentication; only on a network "
               "of its own"},
    SettingRow{"discovery-interval-ms", &Settings::discovery_interval_ms, "MS", 10, kLongestMs,
               "how often DDS announces itself"},
    SettingRow{"lease-ms", &Settings::lease_ms, "MS", 100, kLongestMs,
               "a silent gateway is given up after this"},
    SettingRow{"log", &Settings::log, "FILE", 0, 0, "log file; without it, standard error"},
    SettingRow{"log-level", &Settings::log_level, "LEVEL", 0, 0, "debug, info, warn, error or off"},
    SettingRow{"log-mb", &Settings::log_mb, "MB", 1, 10'000,
               "size of the log file; then it is numbered and a new one begun"},
    SettingRow{"log-files", &Settings::log_files, "NUMBER", 0, 1000,
               "numbered log files that are kept"},
};

const SettingRow* find_row(std::string_view name) {
  for (const auto& row : kRows) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

Result<void> check_range(const SettingRow& row, std::int64_t value) {
  if (value >= row.lowest && value <= row.highest) return {};
  return fail(Errc::LimitExceeded, "{} = {}: must be {} to {}", row.name, value, row.lowest,
              row.highest);
}

Result<void> apply_value(Settings& settings, const SettingRow& row, const toml::node& node) {
  const auto line = node.source().begin.line;
  if (const auto* text = std::get_if<std::string Settings::*>(&row.member)) {
    if (!node.is_string())
      return fail(Errc::Syntax, "line {}: {} must be a string", line, row.name);
    settings.*(*text) = node.as_string()->get();
    return {};
  }
  if (!node.is_integer()) {
    return fail(Errc::Syntax, "line {}: {} must be a whole number", line, row.name);
  }
  const std::int64_t value = node.as_integer()->get();
  if (auto good = check_range(row, value); !good) {
    return fail(good.error().code, "line {}: {}", line, good.error().what);
  }
  settings.*std::get<std::uint32_t Settings::*>(row.member) = static_cast<std::uint32_t>(value);
  return {};
}

Result<void> apply_file(Settings& settings, const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return fail(Errc::NotFound, "configuration file '{}' cannot be read", path);
  std::ostringstream text;
  text << file.rdbuf();
  const auto folder = std::filesystem::path(path).parent_path();
  auto applied = apply_toml(settings, text.str(), folder.string());
  if (!applied) return fail(applied.error().code, "{}: {}", path, applied.error().what);
  return {};
}

/// Command-line values wait here, so that those that were given can be put over the file's.
struct Given {
  std::map<std::string_view, std::string> texts;
  std::map<std::string_view, std::uint32_t> numbers;
};

void add_options(CLI::App& program, Given& given, const Settings& defaults) {
  for (const auto& row : kRows) {
    const std::string option = "--" + std::string(row.name);
    CLI::Option* added = nullptr;
    if (const auto* text = std::get_if<std::string Settings::*>(&row.member)) {
      given.texts[row.name] = defaults.*(*text);
      added = program.add_option(option, given.texts[row.name], std::string(row.text));
    } else {
      given.numbers[row.name] = defaults.*std::get<std::uint32_t Settings::*>(row.member);
      added = program.add_option(option, given.numbers[row.name], std::string(row.text));
      added->check(CLI::Range(row.lowest, row.highest));
    }
    added->type_name(std::string(row.unit));
    added->capture_default_str();
  }
}

void apply_given(const CLI::App& program, const Given& given, Settings& settings) {
  for (const auto& row : kRows) {
    if (program.count("--" + std::string(row.name)) == 0) continue;
    if (const auto* text = std::get_if<std::string Settings::*>(&row.member)) {
      settings.*(*text) = given.texts.at(row.name);
    } else {
      settings.*std::get<std::uint32_t Settings::*>(row.member) = given.numbers.at(row.name);
    }
  }
}

constexpr int kUsageError = 2;

CommandLine wrong_use(const Error& error) {
  return {.settings = {}, .print = "dncd: " + error.what + "\n", .exit_code = kUsageError};
}

}  // namespace

std::span<const SettingRow> setting_rows() {
  return kRows;
}

Result<void> apply_toml(Settings& settings, std::string_view text, const std::string& folder) {
  try {
    const toml::table table = toml::parse(text);
    for (const auto& [key, node] : table) {
      if (key.str() == "port") {
        auto ports = read_ports(node, folder);
        if (!ports) return fail(ports.error());
        settings.ports = *std::move(ports);
        continue;
      }
      const SettingRow* row = find_row(key.str());
      if (row == nullptr) {
        return fail(Errc::Syntax, "line {}: key '{}' is not known", node.source().begin.line,
                    key.str());
      }
      if (auto good = apply_value(settings, *row, node); !good) return good;
    }
  } catch (const toml::parse_error& e) {
    return fail(Errc::Syntax, "line {}: {}", e.source().begin.line, e.description());
  }
  return {};
}

CommandLine read_command_line(int argc, const char* const* argv) {
  CommandLine line;
  const auto state = default_state_folder(process_environment, ::geteuid() == 0);
  if (state) line.settings.state = *state;
  CLI::App program("dncd: the Dripline server. Keeps NC programs, feeds machines, stores reports.",
                   "dncd");
  program.set_version_flag("--version", std::string("dncd ") + DRIPLINE_VERSION);
  program.footer(
      "Exit codes: 0 ended by a signal, 1 could not start or go on, 2 wrong use or unsafe "
      "settings.");
  std::string config;
  program.add_option("--config", config, "TOML file with these settings; the command line wins")
      ->type_name("FILE");
  program.add_flag("--begin-empty", line.settings.begin_empty,
                   "begin with an empty database where the one of this folder was lost");
  Given given;
  add_options(program, given, line.settings);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    std::ostringstream out;
    std::ostringstream err;
    const bool is_wrong = program.exit(e, out, err) != 0;
    line.print = out.str() + err.str();
    line.exit_code = is_wrong ? kUsageError : 0;
    return line;
  }
  if (!config.empty()) {
    if (auto applied = apply_file(line.settings, config); !applied)
      return wrong_use(applied.error());
  }
  apply_given(program, given, line.settings);
  if (!state && line.settings.state.empty()) return wrong_use(state.error());
  return line;
}

}  // namespace dripline::app
