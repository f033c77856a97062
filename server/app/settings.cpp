#include "server/app/settings.hpp"

#include <toml++/toml.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "protocol/base/private_folder.hpp"
#include "protocol/base/result.hpp"
#include "protocol/dds/endpoint.hpp"
#include "protocol/process/settings_reader.hpp"
#include "storage/port_store.hpp"

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

/// Reads the serial ports of a configuration file:
///
///     [[port]]
///     name = "mill-3"                  # default: the machine's name
///     machine = "mill-3"
///     address = "/dev/ttyUSB0"         # or tcp://host:port, rfc2217://host:port
///     template = "tnc155"
///     enabled = true                   # the default
///     rules_file = "rules.toml"        # or rules = '''...''', the text itself
///     baud = 4800                      # and every other key of a line (dnc port templates)
///
/// What the line's keys mean is judged when the port is saved. Errors: Syntax, NotFound (a file),
/// LimitExceeded; they name line and key.
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

using process::number_value;
using process::text_value;
using process::yes_no_value;
using Row = process::SettingRow<Settings>;

constexpr std::uint64_t kHoursOfYear = 8760;
constexpr std::uint32_t kMostCacheMb = 4'000'000;
constexpr std::uint32_t kMostThousands = 4'000'000;
constexpr std::uint64_t kLongestMs = 600'000;
constexpr std::uint64_t kMaxConnections = 800;  ///< DDS waits with select(): below 1,000 files

constexpr std::array kRows{
    Row{"state", "DIR", "", "", "Folder of the database, the token and dncd.json",
        text_value<&Settings::state>()},
    Row{"store", "URL", "", "a SQLite file in the state folder",
        "PostgreSQL database that everything is kept in: postgresql://HOST:PORT/NAME; its password "
        "belongs in ~/.pgpass",
        text_value<&Settings::store>()},
    Row{"program-cache-mb", "NUMBER", "MB", "",
        "With --store: program text kept in the state folder too, from which machines are fed "
        "while the database is away; 0: none",
        number_value<0, kMostCacheMb, &Settings::program_cache_mb>()},
    Row{"standby", "yes|no", "", "",
        "With --store: yes: where another server has the database, wait and take over when it ends "
        "or is gone; for each of the servers of one database",
        yes_no_value<&Settings::standby>()},
    Row{"takeover-s", "NUMBER", "s", "",
        "With --store: let another server take over when this one has not renewed its place for "
        "so long, by the other one's steady clock",
        number_value<2, 60, &Settings::takeover_s>()},
    Row{"handover-s", "NUMBER", "s", "",
        "With standby: hand over to a server that waits when this one has heard no gateway for so "
        "long and that one hears some; 0: only people hand over",
        number_value<0, 600, &Settings::handover_s>()},
    Row{"http", "HOST:PORT", "", "", "Address of the REST API; port 0 takes a free one",
        text_value<&Settings::http>()},
    Row{"tls-certificate", "FILE", "", "",
        "Certificate chain (PEM); needed to listen beyond this computer (loopback)",
        text_value<&Settings::tls_certificate>()},
    Row{"tls-key", "FILE", "", "", "Private key of the certificate (PEM)",
        text_value<&Settings::tls_key>()},
    Row{"tls-client-ca", "FILE", "", "none",
        "Authority of clients' certificates (PEM): who shows one is the user of its common name, "
        "without a token",
        text_value<&Settings::tls_client_ca>()},
    Row{"tls-client-revoked", "FILE", "", "none",
        "Serials of clients' certificates that are not accepted any more, one a line; read again "
        "when it changes",
        text_value<&Settings::tls_client_revoked>()},
    Row{"policy", "FILE", "", "what is pushed may run",
        "Which revisions machines run, and who submits, approves and releases them (TOML)",
        text_value<&Settings::policy>()},
    Row{"http-connections", "NUMBER", "", "",
        "Connections to the REST API at once; a new one replaces the one that has been idle "
        "longest",
        number_value<16, kMaxConnections, &Settings::http_connections>()},
    Row{"http-connections-per-address", "NUMBER", "", "",
        "Connections from one address at once; raise it behind a proxy",
        number_value<4, kMaxConnections, &Settings::http_connections_per_address>()},
    Row{"http-event-streams", "NUMBER", "", "",
        "Event streams at once; at most half of the connections",
        number_value<1, kMaxConnections, &Settings::http_event_streams>()},
    Row{"mtconnect", "HOST:PORT", "", "none",
        "Address of the MTConnect agent, which tells all machines' states to anybody who reaches "
        "it (read only, without TLS or a token); port 0 takes a free one",
        text_value<&Settings::mtconnect>()},
    Row{"mtconnect-open-network", "yes|no", "", "",
        "yes: allow the MTConnect agent beyond this computer although anybody there may read",
        yes_no_value<&Settings::mtconnect_open_network>()},
    Row{"dds-domain", "NUMBER", "", "", "DDS domain",
        number_value<0, 230, &Settings::dds_domain>()},
    Row{"dds-tag", "TEXT", "", "", "Name of this system; systems with different tags are separate",
        text_value<&Settings::dds_tag>()},
    Row{"dds-cells", "NUMBER", "", "",
        "Parts of the DDS side, two UDP ports each: 8, or 16, 32, 64 for hundreds of machines; as "
        "many as the gateways have, or more",
        number_value<dds::kFewestCells, dds::kMostCells, &Settings::dds_cells>()},
    Row{"dds-port", "NUMBER", "", "7410 + 250 * dds-domain",
        "First UDP port of the DDS side, two for each cell from there; gateways name it: --server "
        "HOST:PORT",
        number_value<0, 65535, &Settings::dds_port>()},
    Row{"dds-interface", "NAME", "", "", "Network interface or address that leads to the gateways",
        text_value<&Settings::dds_interface>()},
    Row{"dds-security", "DIR", "", "none: no authentication",
        "Folder with this server's certificate, key and permissions (dnc pki server); needed for "
        "DDS beyond this computer",
        text_value<&Settings::dds_security>()},
    Row{"dds-open-network", "yes|no", "", "",
        "yes: allow DDS beyond this computer without dds-security; only on a network of its own",
        yes_no_value<&Settings::dds_open_network>()},
    Row{"discovery-interval-ms", "NUMBER", "ms", "", "Interval between two announcements of DDS",
        number_value<10, kLongestMs, &Settings::discovery_interval_ms>()},
    Row{"lease-ms", "NUMBER", "ms", "", "Consider a gateway disconnected after this much silence",
        number_value<100, kLongestMs, &Settings::lease_ms>()},
    Row{"backups", "DIR", "", "none",
        "Folder of the backups, best on another disk; without it none are made",
        text_value<&Settings::backups>()},
    Row{"backup-every-hours", "NUMBER", "h", "",
        "Make a backup this often; 0: only on request (dnc server backup)",
        number_value<0, kHoursOfYear, &Settings::backup_every_hours>()},
    Row{"backup-keep-days", "NUMBER", "d", "", "Keep every backup of the last days",
        number_value<1, 3650, &Settings::backup_keep_days>()},
    Row{"backup-keep-weeks", "NUMBER", "", "", "Keep one backup of each of the last weeks",
        number_value<0, 520, &Settings::backup_keep_weeks>()},
    Row{"archives", "DIR", "", "none: everything stays in the database",
        "Folder of the archives that old records and measurements are moved into",
        text_value<&Settings::archives>()},
    Row{"archive-records-days", "NUMBER", "d", "",
        "Move records (report lines, alarms ...) into archives after so many days; 0: never",
        number_value<0, 36500, &Settings::archive_records_days>()},
    Row{"archive-records-thousands", "NUMBER", "", "",
        "Move the oldest records into archives when there are more thousands of them; 0: never",
        number_value<0, kMostThousands, &Settings::archive_records_rows>()},
    Row{"archive-measurements-days", "NUMBER", "d", "",
        "Move measurements into archives so many days after their part; 0: never",
        number_value<0, 36500, &Settings::archive_measurements_days>()},
    Row{"archive-measurements-thousands", "NUMBER", "", "",
        "Move the oldest measurements into archives when there are more thousands; 0: never",
        number_value<0, kMostThousands, &Settings::archive_measurements_rows>()},
    Row{"log", "FILE", "", "standard error", "Log file", text_value<&Settings::log>()},
    Row{"log-level", "LEVEL", "", "",
        "Lowest level that is logged: debug, info, warn, error or off",
        text_value<&Settings::log_level>()},
    Row{"log-mb", "NUMBER", "MB", "", "Rotate the log file at this size",
        number_value<1, 10'000, &Settings::log_mb>()},
    Row{"log-files", "NUMBER", "", "", "Keep this many rotated log files",
        number_value<0, 1000, &Settings::log_files>()},
};

constexpr const char* kPorts = "port";      ///< the tables [[port]] are read here, not by the rows
constexpr const char* kFolders = "folder";  ///< likewise [[folder]], by server/folders
constexpr const char* kMqtt = "mqtt";       ///< likewise [mqtt], by server/mqtt

Result<void> apply_ports(Settings& settings, std::string_view text, const std::string& folder) {
  const toml::table table = toml::parse(text);  // the rows were read from it before
  const toml::node* node = table.get(kPorts);
  if (node == nullptr) return {};
  auto ports = read_ports(*node, folder);
  if (!ports) return fail(ports.error());
  settings.ports = *std::move(ports);
  return {};
}

Result<void> apply_file(Settings& settings, const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) {
    return fail(Errc::NotFound, "configuration file '{}' cannot be read", path);
  }
  const auto folder = std::filesystem::path(path).parent_path();
  auto applied = apply_toml(settings, text.str(), folder.string());
  if (!applied) return fail(applied.error().code, "{}: {}", path, applied.error().what);
  return {};
}

constexpr int kUsageError = 2;

CommandLine wrong_use(const Error& error) {
  return {.settings = {}, .print = "dncd: " + error.what + "\n", .exit_code = kUsageError};
}

std::string refuse_empty(const std::string& value) {
  return value.empty() ? "a value is needed, this one is empty" : "";
}

}  // namespace

Result<void> apply_toml(Settings& settings, std::string_view text, const std::string& folder) {
  const process::SettingsReader reader(std::span<const Row>(kRows), settings);
  if (auto read = reader.read_toml(text, {kPorts, kFolders, kMqtt}); !read) return read;
  auto folders = folders::read_folders(text);
  if (!folders) return fail(folders.error());
  settings.folders = *std::move(folders);
  auto broker = mqtt::read_mqtt(text);
  if (!broker) return fail(broker.error());
  settings.mqtt = *std::move(broker);
  return apply_ports(settings, text, folder);
}

CommandLine read_command_line(int argc, const char* const* argv) {
  CommandLine line;
  const auto state = default_state_folder(process_environment, ::geteuid() == 0);
  if (state) line.settings.state = *state;
  CLI::App program("dncd: the Dripline server. Keeps NC programs, feeds machines, stores reports.",
                   "dncd");
  program.set_version_flag("--version", std::string("dncd ") + DRIPLINE_VERSION);
  program.footer(
      "Exit status: 0 ended by a signal or a hand-over, 1 could not start or continue, 2 usage "
      "error or unsafe "
      "settings.");
  std::string config;
  program
      .add_option("--config", config,
                  "TOML file with these settings; the command line takes precedence")
      ->type_name("FILE");
  program.add_flag("--begin-empty", line.settings.begin_empty,
                   "Start with an empty database if this folder's database is missing");
  program.add_flag("--recover-admin", line.settings.recover_admin,
                   "Make user admin an active administrator again, with this folder's token");
  program
      .add_option("--restore", line.settings.restore,
                  "Bring this backup (or: newest) of --backups into the state folder, and end")
      ->type_name("BACKUP");
  program
      .add_option("--migrate-to", line.settings.migrate_to,
                  "Move everything into this PostgreSQL database, or from --store into a SQLite "
                  "file of the state folder, and end")
      ->type_name("URL|DIR");
  program.add_flag("--json", line.settings.wants_json, "Report a migration as JSON");
  process::SettingsReader reader(std::span<const Row>(kRows), line.settings);
  reader.declare(program);
  // An empty variable in a script would start a server instead, or on another database.
  for (const char* name : {"--migrate-to", "--store"})
    program.get_option(name)->check(CLI::Validator(refuse_empty, ""));
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
  if (auto applied = reader.apply_command_line(); !applied) return wrong_use(applied.error());
  if (!state && line.settings.state.empty()) return wrong_use(state.error());
  return line;
}

}  // namespace dripline::app
