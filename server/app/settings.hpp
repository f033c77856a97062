#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocol/base/result.hpp"
#include "storage/port_store.hpp"

namespace dripline::app {

/// Everything that can be told to dncd. The defaults are here, the rest in the table below.
struct Settings {
  std::string state;  ///< default: default_state_folder (protocol/base/state_location.hpp)
  std::string http = "127.0.0.1:8430";
  std::string tls_certificate, tls_key;
  std::uint32_t http_connections = 512;
  std::uint32_t http_connections_per_address = 256;
  std::uint32_t http_event_streams = 256;
  std::uint32_t dds_domain = 0;
  std::string dds_tag;
  std::string dds_interface = "lo";
  std::string dds_open_network = "no";
  std::uint32_t discovery_interval_ms = 250;
  std::uint32_t lease_ms = 2000;
  std::string log;
  std::string log_level = "info";
  std::uint32_t log_mb = 10;
  std::uint32_t log_files = 5;
  bool begin_empty = false;          ///< on the command line alone: once, by somebody who looks
  std::vector<storage::Port> ports;  ///< saved at the start, over what is stored under their names
};

/// One row for each setting: the same table makes the command line, the configuration file and
/// their help. A row `lease-ms` is `--lease-ms` and `lease-ms = ...`.
struct SettingRow {
  std::string_view name;
  std::variant<std::string Settings::*, std::uint32_t Settings::*> member;
  std::string_view unit;                  ///< shown with the value in the help
  std::uint32_t lowest = 0, highest = 0;  ///< numbers only
  std::string_view text;
};
std::span<const SettingRow> setting_rows();

/// Sets what the text of a TOML file says: the rows above, and serial ports (port_table.hpp), whose
/// files are looked for in `folder`. Errors: Syntax (also an unknown key, a wrong type),
/// LimitExceeded, NotFound; names key and line.
Result<void> apply_toml(Settings& settings, std::string_view toml, const std::string& folder = "");

/// What the command line asks for: to run, or only to print something and end.
struct CommandLine {
  Settings settings;
  std::string print;  ///< help, version or an error; empty: run
  int exit_code = 0;
};
/// The command line wins over the file named by --config, that over the defaults.
CommandLine read_command_line(int argc, const char* const* argv);

}  // namespace dripline::app
