#include "storage/impl/repositories.hpp"

#include <algorithm>

#include "protocol/base/names.hpp"
#include "storage/impl/content.hpp"
#include "storage/sqlite/query.hpp"

namespace dripline::storage {

namespace {

const std::string kSelect =
    "SELECT name, control, description, gateway_version, machine.epoch, "
    "coalesce(record_epoch.last, 0), first_seen_us, last_seen_us FROM machine "
    "LEFT JOIN record_epoch "
    "ON record_epoch.machine = machine.id AND record_epoch.epoch = machine.epoch ";

Machine read_machine(const sqlite::Statement& row) {
  return {row.text(0),   row.text(1),   row.text(2), row.text(3),
          row.number(4), row.number(5), row.time(6), row.time(7)};
}

}  // namespace

Result<std::int64_t> machine_id(sqlite::Database& database, const std::string& name,
                                std::uint64_t epoch, UtcTime now) {
  const auto known = sqlite::first_row(
      database, "SELECT id FROM machine WHERE name = ?1",
      [](const sqlite::Statement& row) { return row.integer(0); }, name);
  if (!known) return fail(known.error());
  if (*known) return **known;
  if (auto checked = check_machine_name(name); !checked) return fail(checked.error());
  const auto made = sqlite::run(
      database,
      "INSERT INTO machine (name, control, description, gateway_version, epoch, first_seen_us, "
      "last_seen_us) VALUES (?1, '', '', '', ?2, ?3, ?3)",
      name, epoch, now);
  if (!made) return fail(made.error());
  return database.last_insert_id();
}

Result<void> MachineRepository::save(const Machine& machine) {
  if (auto checked = check_machine_name(machine.name); !checked) return checked;
  return connections_.write([&](sqlite::Database& database) {
    return sqlite::run(
        database,
        "INSERT INTO machine (name, control, description, gateway_version, epoch, first_seen_us, "
        "last_seen_us) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7) ON CONFLICT (name) DO UPDATE SET "
        "control = excluded.control, description = excluded.description, "
        "gateway_version = excluded.gateway_version, epoch = excluded.epoch, "
        "first_seen_us = min(first_seen_us, excluded.first_seen_us), "
        "last_seen_us = max(last_seen_us, excluded.last_seen_us)",
        machine.name, machine.control, machine.description, machine.gateway_version, machine.epoch,
        machine.first_seen, machine.last_seen);
  });
}

Result<Machine> MachineRepository::find(const std::string& name) {
  static const std::string kSql = kSelect + "WHERE name = ?1";
  auto found = connections_.read([&](sqlite::Database& database) {
    return sqlite::first_row(database, kSql, read_machine, name);
  });
  if (!found) return fail(found.error());
  if (!*found) return fail(Errc::NotFound, "machine {} is not known", name);
  return std::move(**found);
}

Result<std::vector<Machine>> MachineRepository::list() {
  static const std::string kSql = kSelect + "ORDER BY name";
  return connections_.read(
      [&](sqlite::Database& database) { return sqlite::all_rows(database, kSql, read_machine); });
}

namespace {

/// Everything but the text.
constexpr const char* kColumns =
    "machine, number, sha256, length(CAST(text AS BLOB)), comment, author, created_us";

SetupRevision read_setup(const sqlite::Statement& row) {
  SetupRevision setup;
  setup.machine = row.text(0);
  setup.number = row.number(1);
  setup.sha256 = read_digest(row, 2);
  setup.size = row.number(3);
  setup.comment = row.text(4);
  setup.author = row.text(5);
  setup.created = row.time(6);
  return setup;
}
SetupRevision read_with_text(const sqlite::Statement& row) {
  SetupRevision setup = read_setup(row);
  setup.text = row.text(7);
  return setup;
}

Result<std::optional<SetupRevision>> newest(sqlite::Database& database,
                                            const std::string& machine) {
  static const std::string kSql = fmt::format(
      "SELECT {}, text FROM setup WHERE machine = ?1 ORDER BY number DESC LIMIT 1", kColumns);
  return sqlite::first_row(database, kSql, read_with_text, machine);
}

Result<void> check_setup(const SetupRevision& setup) {
  if (auto named = check_machine_name(setup.machine); !named) return named;
  if (setup.text.size() <= kMaxSetup) return {};
  return fail(Errc::LimitExceeded, "machine {}: a setup of {} bytes, at most {}", setup.machine,
              setup.text.size(), kMaxSetup);
}

/// A text that was made from `base` never replaces one that was stored since.
Result<void> check_base(const SetupRevision& setup, std::optional<std::uint64_t> base,
                        std::uint64_t newest) {
  if (!base || *base == newest) return {};
  const std::string made_from = *base == 0 ? "before there was one" : fmt::format("from {}", *base);
  if (newest == 0) {
    return fail(Errc::Conflict, "machine {}: this setup was made {}, and there is none",
                setup.machine, made_from);
  }
  return fail(Errc::Conflict,
              "machine {}: this setup was made {}, and {} is the newest by now; nothing was stored",
              setup.machine, made_from, newest);
}

Result<void> insert(sqlite::Database& database, const SetupRevision& setup) {
  return sqlite::run(database,
                     "INSERT INTO setup (machine, number, text, sha256, comment, author, "
                     "created_us) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)",
                     setup.machine, setup.number, setup.text,
                     std::span<const std::byte>(setup.sha256.bytes), setup.comment, setup.author,
                     setup.created);
}

}  // namespace

Result<SetupRevision> SetupRepository::save(const SetupRevision& given,
                                            std::optional<std::uint64_t> base) {
  if (auto checked = check_setup(given); !checked) return fail(checked.error());
  SetupRevision setup = given;
  setup.sha256 = sha256(setup.text);
  setup.size = setup.text.size();
  setup.created = clock_.now();
  const auto saved = connections_.write([&](sqlite::Database& database) -> Result<void> {
    auto known = newest(database, setup.machine);
    if (!known) return fail(known.error());
    if (*known && (*known)->sha256 == setup.sha256) {
      setup = std::move(**known);
      return {};
    }
    const std::uint64_t before = *known ? (*known)->number : 0;
    if (auto fresh = check_base(setup, base, before); !fresh) return fresh;
    setup.number = before + 1;
    return insert(database, setup);
  });
  if (!saved) return fail(saved.error());
  return setup;
}

Result<std::vector<SetupRevision>> SetupRepository::list(const std::string& machine, Page page) {
  static const std::string kSql = fmt::format(
      "SELECT {} FROM setup WHERE machine = ?1 ORDER BY number DESC LIMIT ?2 OFFSET ?3", kColumns);
  return connections_.read([&](sqlite::Database& database) {
    return sqlite::all_rows(database, kSql, read_setup, machine, page.limit, page.offset);
  });
}

Result<SetupRevision> SetupRepository::find(const std::string& machine,
                                            std::optional<std::uint64_t> number) {
  static const std::string kSql =
      fmt::format("SELECT {}, text FROM setup WHERE machine = ?1 AND number = ?2", kColumns);
  return connections_.read([&](sqlite::Database& database) -> Result<SetupRevision> {
    auto found = number ? sqlite::first_row(database, kSql, read_with_text, machine, *number)
                        : newest(database, machine);
    if (!found) return fail(found.error());
    if (*found) return std::move(**found);
    if (!number) return fail(Errc::NotFound, "machine {} has no setup on the server", machine);
    return fail(Errc::NotFound, "machine {} has no setup {}", machine, *number);
  });
}

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
Result<void> check_address_free(sqlite::Database& database, const Port& port) {
  const auto owner = sqlite::first_row(
      database, "SELECT name FROM port WHERE address = ?1 AND name <> ?2",
      [](const sqlite::Statement& row) { return row.text(0); }, port.address, port.name);
  if (!owner) return fail(owner.error());
  if (!*owner) return {};
  return fail(Errc::Busy, "address {} is port {}'s already", port.address, **owner);
}

Result<void> save_settings(sqlite::Database& database, const Port& port) {
  auto done = sqlite::run(database, "DELETE FROM port_setting WHERE port = ?1", port.name);
  for (std::size_t at = 0; done && at < port.settings.size(); ++at) {
    const auto& [key, value] = port.settings[at];
    done = sqlite::run(
        database, "INSERT INTO port_setting (port, position, key, value) VALUES (?1, ?2, ?3, ?4)",
        port.name, at, key, value);
  }
  return done;
}

Port read_port(const sqlite::Statement& row) {
  Port port;
  port.name = row.text(0);
  port.machine = row.text(1);
  port.address = row.text(2);
  port.line_template = row.text(3);
  port.rules = row.text(4);
  port.is_enabled = row.integer(5) != 0;
  return port;
}

using Setting = std::pair<std::string, std::string>;

}  // namespace

Result<void> PortRepository::save(const Port& port) {
  if (auto checked = check_port(port); !checked) return checked;
  return connections_.write([&](sqlite::Database& database) -> Result<void> {
    if (auto is_free = check_address_free(database, port); !is_free) return is_free;
    const auto saved =
        sqlite::run(database,
                    "INSERT INTO port (name, machine, address, line_template, rules, is_enabled) "
                    "VALUES (?1, ?2, ?3, ?4, ?5, ?6) ON CONFLICT (name) DO UPDATE SET "
                    "machine = excluded.machine, address = excluded.address, "
                    "line_template = excluded.line_template, rules = excluded.rules, "
                    "is_enabled = excluded.is_enabled",
                    port.name, port.machine, port.address, port.line_template, port.rules,
                    port.is_enabled ? 1 : 0);
    if (!saved) return saved;
    return save_settings(database, port);
  });
}

Result<std::vector<Port>> PortRepository::list() {
  return connections_.read([&](sqlite::Database& database) -> Result<std::vector<Port>> {
    auto ports = sqlite::all_rows(
        database,
        "SELECT name, machine, address, line_template, rules, is_enabled FROM port ORDER BY name",
        read_port);
    if (!ports) return ports;
    for (Port& port : *ports) {
      auto settings = sqlite::all_rows(
          database, "SELECT key, value FROM port_setting WHERE port = ?1 ORDER BY position",
          [](const sqlite::Statement& row) { return Setting(row.text(0), row.text(1)); },
          port.name);
      if (!settings) return fail(settings.error());
      port.settings = std::move(*settings);
    }
    return ports;
  });
}

Result<void> PortRepository::remove(const std::string& name) {
  return connections_.write([&](sqlite::Database& database) -> Result<void> {
    const auto removed = sqlite::run(database, "DELETE FROM port WHERE name = ?1", name);
    if (!removed) return removed;
    if (database.changes() == 0) return fail(Errc::NotFound, "port {} is not known", name);
    return {};
  });
}

Result<void> apply_beginning(sqlite::Database& database, std::int64_t machine,
                             const RunBeginning& beginning) {
  return sqlite::run(database,
                     "UPDATE run SET state = 'active', started_us = max(?2, created_us) "
                     "WHERE id = ?1 AND machine = ?3 AND state = 'ordered'",
                     beginning.run, beginning.started, machine);
}

Result<void> apply_ending(sqlite::Database& database, std::int64_t machine,
                          const RunEnding& ending) {
  if (!is_finished(ending.state)) {
    return fail(Errc::Syntax, "run {}: {} is not an end", ending.run, to_string(ending.state));
  }
  const auto ended = sqlite::run(
      database,
      "UPDATE run SET state = ?2, sent = max(sent, ?3), accepted = max(accepted, ?4), "
      "executed = max(executed, ?5), line = ?6, sequence = ?7, reason = ?8, "
      "executed_content = ?9, content_verified = ?10, "
      "ended_us = max(?11, coalesce(started_us, created_us)) "
      "WHERE id = ?1 AND machine = ?12 AND state IN ('ordered', 'active')",
      ending.run, to_string(ending.state), ending.counters.sent, ending.counters.accepted,
      ending.counters.executed, ending.line, ending.sequence, ending.reason,
      ending.executed_content, ending.content_verified, ending.ended, machine);
  if (!ended || database.changes() == 0) return ended;
  return add_run_end(database, ending.run);
}

Result<void> add_outputs(sqlite::Database& database, std::int64_t machine,
                         const NewOutputs& outputs) {
  return sqlite::run(database,
                     "UPDATE run SET outputs = outputs + ?2 WHERE id = ?1 AND machine = ?3",
                     outputs.run, outputs.count, machine);
}

}  // namespace dripline::storage
