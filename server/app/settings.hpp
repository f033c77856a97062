#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.hpp"
#include "server/folders/folder_settings.hpp"
#include "server/mqtt/mqtt_settings.hpp"
#include "storage/port_store.hpp"

namespace dripline::app {

/// Everything that can be set of dncd. The defaults are here, the rest in the table of
/// settings.cpp, from which command line, configuration file and help are made.
struct Settings {
  std::string state;  ///< default: default_state_folder (protocol/base/private_folder.hpp)
  std::string store;  ///< postgresql://...; empty: a SQLite file in `state`
  std::uint32_t program_cache_mb = 4096;  ///< of a PostgreSQL database's program text; 0: none
  bool standby = false;                   ///< another server's database: waits for its place
  std::uint32_t takeover_s = 3;  ///< without renewal, and another server may have the place
  std::uint32_t handover_s = 4;  ///< without gateways, that another server hears; 0: never
  std::string http = "127.0.0.1:8430";
  std::string tls_certificate, tls_key;
  std::string tls_client_ca, tls_client_revoked;  ///< files; empty: none
  std::string policy;                             ///< file; empty: what is pushed may run
  std::uint32_t http_connections = 512;
  std::uint32_t http_connections_per_address = 256;
  std::uint32_t http_event_streams = 256;
  std::string mtconnect;                ///< address of the MTConnect agent; empty: there is none
  bool mtconnect_open_network = false;  ///< beyond this computer, although anybody may read there
  std::uint32_t dds_domain = 0;
  std::string dds_tag;
  std::uint32_t dds_port = 0;  ///< 0: by the domain
  std::string dds_interface = "lo";
  std::string dds_security;  ///< folder of `dnc pki`; empty: none
  std::uint32_t dds_cells = 8;
  bool dds_open_network = false;  ///< DDS beyond this machine, although it has no authentication
  std::uint32_t discovery_interval_ms = 250;
  std::uint32_t lease_ms = 2000;
  std::string log;
  std::string log_level = "info";
  std::uint32_t log_mb = 10;
  std::uint32_t log_files = 5;
  std::string backups;  ///< folder of the backups; empty: none are made
  std::uint32_t backup_every_hours = 24;
  std::uint32_t backup_keep_days = 14;
  std::uint32_t backup_keep_weeks = 26;
  std::string archives;  ///< folder of the archives; empty: nothing is taken out of the tables
  std::uint32_t archive_records_days = 0;  ///< 0: by age none; likewise the next ones
  std::uint32_t archive_records_rows = 0;  ///< thousands
  std::uint32_t archive_measurements_days = 0;
  std::uint32_t archive_measurements_rows = 0;  ///< thousands
  std::string restore;               ///< on the command line alone: a backup, or kNewestBackup
  std::string migrate_to;            ///< likewise: postgresql://..., or the state folder
  bool wants_json = false;           ///< likewise, of what a migration reports
  bool begin_empty = false;          ///< on the command line alone, for one start
  bool recover_admin = false;        ///< likewise
  std::vector<storage::Port> ports;  ///< saved at the start, over what is stored under their names
  std::vector<folders::FolderSettings> folders;
  mqtt::MqttSettings mqtt;  ///< without a broker: none
};

inline constexpr const char* kNewestBackup = "newest";

/// Sets what a TOML file holds: the settings of dncd, its hot folders, its broker, and its serial
/// ports, whose files are looked for in `folder`. Errors: Syntax (also an unknown key, a wrong
/// type), LimitExceeded, NotFound; they name key and line.
Result<void> apply_toml(Settings& settings, std::string_view toml, const std::string& folder = "");

/// What the command line asks for: run, or print something and end.
struct CommandLine {
  Settings settings;
  std::string print;  ///< help, version or an error; empty: run
  int exit_code = 0;
};
/// The command line wins over the file named by --config, that over the defaults.
CommandLine read_command_line(int argc, const char* const* argv);

}  // namespace dripline::app
