#include "server/app/settings.hpp"

#include <toml++/toml.h>
#include <unistd.h>
#include <array>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "protocol/base/state_location.hpp"
#include "protocol/process/settings_reader.hpp"
#include "server/app/port_table.hpp"

namespace dripline::app {
namespace {

using process::number_value;
using process::text_value;
using process::yes_no_value;
using Row = process::SettingRow<Settings>;

constexpr std::uint64_t kLongestMs = 600'000;
constexpr std::uint64_t kMaxConnections = 800;  ///< DDS waits with select(): below 1,000 files

constexpr std::array kRows{
    Row{"state", "DIR", "", "", "Folder of the database, the token and dncd.json",
        text_value<&Settings::state>()},
    Row{"http", "HOST:PORT", "", "", "Address of the REST API; port 0 takes a free one",
        text_value<&Settings::http>()},
    Row{"tls-certificate", "FILE", "", "",
        "Certificate chain (PEM); needed to listen beyond this computer (loopback)",
        text_value<&Settings::tls_certificate>()},
    Row{"tls-key", "FILE", "", "", "Private key of the certificate (PEM)",
        text_value<&Settings::tls_key>()},
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
    Row{"dds-domain", "NUMBER", "", "", "DDS domain",
        number_value<0, 230, &Settings::dds_domain>()},
    Row{"dds-tag", "TEXT", "", "", "Name of this system; systems with different tags are separate",
        text_value<&Settings::dds_tag>()},
    Row{"dds-interface", "NAME", "", "", "Network interface or address that leads to the gateways",
        text_value<&Settings::dds_interface>()},
    Row{"dds-open-network", "yes|no", "", "",
        "yes: allow DDS beyond this computer although it has no authentication; only on a network "
        "of its own",
        yes_no_value<&Settings::dds_open_network>()},
    Row{"discovery-interval-ms", "NUMBER", "ms", "", "Interval between two announcements of DDS",
        number_value<10, kLongestMs, &Settings::discovery_interval_ms>()},
    Row{"lease-ms", "NUMBER", "ms", "", "Consider a gateway disconnected after this much silence",
        number_value<100, kLongestMs, &Settings::lease_ms>()},
    Row{"log", "FILE", "", "standard error", "Log file", text_value<&Settings::log>()},
    Row{"log-level", "LEVEL", "", "",
        "Lowest level that is logged: debug, info, warn, error or off",
        text_value<&Settings::log_level>()},
    Row{"log-mb", "NUMBER", "MB", "", "Rotate the log file at this size",
        number_value<1, 10'000, &Settings::log_mb>()},
    Row{"log-files", "NUMBER", "", "", "Keep this many rotated log files",
        number_value<0, 1000, &Settings::log_files>()},
};

constexpr const char* kPorts = "port";  ///< the tables [[port]] are read here, not by the rows

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

}  // namespace

Result<void> apply_toml(Settings& settings, std::string_view text, const std::string& folder) {
  const process::SettingsReader reader(std::span<const Row>(kRows), settings);
  if (auto read = reader.read_toml(text, {kPorts}); !read) return read;
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
      "Exit status: 0 ended by a signal, 1 could not start or continue, 2 usage error or unsafe "
      "settings.");
  std::string config;
  program
      .add_option("--config", config,
                  "TOML file with these settings; the command line takes precedence")
      ->type_name("FILE");
  program.add_flag("--begin-empty", line.settings.begin_empty,
                   "Start with an empty database if this folder's database is missing");
  process::SettingsReader reader(std::span<const Row>(kRows), line.settings);
  reader.declare(program);
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
