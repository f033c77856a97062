#include <algorithm>

#include "protocol/base/names.hpp"
#include "storage/impl/repositories.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage {

namespace {

Result<void> check_port(const Port& port) {
  if (auto named = check_port_name(port.name); !named) return named;
  if (auto named = check_machine_name(port.machine); !named) return named;
  if (port.address.empty()) return fail(Errc::Syntax, "port {}: its address is empty", port.name);
  if (port.settings.size() > kMaxPortSettings) {
    return fail(Errc::LimitExceeded, "port {}: {} settings, at most {}", port.name,
                port.settings.size(), kMaxPortSettings);
  }
  if (port.rules.size() > kMaxPortRules) {
    return fail(Errc::LimitExceeded, "port {}: rules of {} bytes, at most {}", port.name,
                port.rules.size(), kMaxPortRules);
  }
  for (auto at = port.settings.begin(); at != port.settings.end(); ++at) {
    const auto same = [&](const auto& other) { return other.first == at->first; };
    if (std::any_of(std::next(at), port.settings.end(), same)) {
      return fail(Errc::Syntax, "port {}: setting '{}' is given twice", port.name, at->first);
    }
  }
  return {};
}

/// Two ports at one address would both write to the line.
Result<void> check_address_free(sql::Database& database, const Port& port) {
  const auto owner = sql::first_row(
      database, "SELECT name FROM port WHERE address = ?1 AND name <> ?2",
      [](const sql::Statement& row) { return row.text(0); }, port.address, port.name);
  if (!owner) return fail(owner.error());
  if (!*owner) return {};
  return fail(Errc::Busy, "address {} is port {}'s already", port.address, **owner);
}

Result<void> save_settings(sql::Database& database, const Port& port) {
  auto done = sql::run(database, "DELETE FROM port_setting WHERE port = ?1", port.name);
  for (std::size_t at = 0; done && at < port.settings.size(); ++at) {
    const auto& [key, value] = port.settings[at];
    done = sql::run(database,
                    "INSERT INTO port_setting (port, position, key, value) VALUES (?1, ?2, ?3, ?4)",
                    port.name, at, key, value);
  }
  return done;
}

Port read_port(const sql::Statement& row) {
  Port port;
  port.name = row.text(0);
  port.machine = row.text(1);
  port.address = row.text(2);
  port.line_template = row.text(3);
  port.rules = row.text(4);
  port.is_enabled = row.integer(5) != 0;
  port.host = row.text(6);
  return port;
}

using Setting = std::pair<std::string, std::string>;

}  // namespace

Result<void> PortRepository::save(const Port& port) {
  if (auto checked = check_port(port); !checked) return checked;
  return connections_.write([&](sql::Database& database) -> Result<void> {
    if (auto is_free = check_address_free(database, port); !is_free) return is_free;
    const auto saved = sql::run(
        database,
        "INSERT INTO port (name, machine, address, line_template, rules, is_enabled, host) "
        "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7) ON CONFLICT (name) DO UPDATE SET "
        "machine = excluded.machine, address = excluded.address, "
        "line_template = excluded.line_template, rules = excluded.rules, "
        "is_enabled = excluded.is_enabled, host = excluded.host",
        port.name, port.machine, port.address, port.line_template, port.rules,
        port.is_enabled ? 1 : 0, port.host);
    if (!saved) return saved;
    return save_settings(database, port);
  });
}

Result<std::vector<Port>> PortRepository::list() {
  return connections_.read([&](sql::Database& database) -> Result<std::vector<Port>> {
    auto ports = sql::all_rows(database,
                               "SELECT name, machine, address, line_template, rules, is_enabled, "
                               "host FROM port ORDER BY name",
                               read_port);
    if (!ports) return ports;
    for (Port& port : *ports) {
      auto settings = sql::all_rows(
          database, "SELECT key, value FROM port_setting WHERE port = ?1 ORDER BY position",
          [](const sql::Statement& row) { return Setting(row.text(0), row.text(1)); }, port.name);
      if (!settings) return fail(settings.error());
      port.settings = std::move(*settings);
    }
    return ports;
  });
}

Result<void> PortRepository::remove(const std::string& name) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto removed = sql::run(database, "DELETE FROM port WHERE name = ?1", name);
    if (!removed) return removed;
    if (database.changes() == 0) return fail(Errc::NotFound, "port {} is not known", name);
    return {};
  });
}

}  // namespace dripline::storage
