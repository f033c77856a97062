#include "protocol/base/names.hpp"
#include "storage/impl/audit_repository.hpp"
#include "storage/impl/repositories.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage {

namespace {

const std::string kSelectMachine =
    "SELECT name, control, description, gateway_version, machine.epoch, "
    "coalesce(record_epoch.last, 0), first_seen_us, last_seen_us FROM machine "
    "LEFT JOIN record_epoch "
    "ON record_epoch.machine = machine.id AND record_epoch.epoch = machine.epoch ";

Machine read_machine(const sql::Statement& row) {
  return {row.text(0),   row.text(1),   row.text(2), row.text(3),
          row.number(4), row.number(5), row.time(6), row.time(7)};
}

}  // namespace

Result<std::int64_t> known_machine(sql::Database& database, const std::string& name) {
  const auto id = sql::first_row(
      database, "SELECT id FROM machine WHERE name = ?1",
      [](const sql::Statement& row) { return row.integer(0); }, name);
  if (!id) return fail(id.error());
  if (!*id) return fail(Errc::NotFound, "machine {} is not known", name);
  return **id;
}

Result<std::int64_t> machine_id(sql::Database& database, const std::string& name,
                                std::uint64_t epoch, UtcTime now) {
  const auto known = sql::first_row(
      database, "SELECT id FROM machine WHERE name = ?1",
      [](const sql::Statement& row) { return row.integer(0); }, name);
  if (!known) return fail(known.error());
  if (*known) return **known;
  if (auto checked = check_machine_name(name); !checked) return fail(checked.error());
  return sql::insert(
      database,
      "INSERT INTO machine (name, control, description, gateway_version, epoch, first_seen_us, "
      "last_seen_us) VALUES (?1, '', '', '', ?2, ?3, ?3) RETURNING id",
      name, epoch, now);
}

Result<void> MachineRepository::save(const Machine& machine) {
  if (auto checked = check_machine_name(machine.name); !checked) return checked;
  return connections_.write([&](sql::Database& database) {
    return sql::run(
        database,
        "INSERT INTO machine (name, control, description, gateway_version, epoch, first_seen_us, "
        "last_seen_us) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7) ON CONFLICT (name) DO UPDATE SET "
        "control = excluded.control, description = excluded.description, "
        "gateway_version = excluded.gateway_version, epoch = excluded.epoch, "
        "first_seen_us = min(machine.first_seen_us, excluded.first_seen_us), "
        "last_seen_us = max(machine.last_seen_us, excluded.last_seen_us), removed_us = NULL",
        machine.name, machine.control, machine.description, machine.gateway_version, machine.epoch,
        machine.first_seen, machine.last_seen);
  });
}

Result<Machine> MachineRepository::find(const std::string& name) {
  static const std::string kSql = kSelectMachine + "WHERE name = ?1";
  auto found = connections_.read(
      [&](sql::Database& database) { return sql::first_row(database, kSql, read_machine, name); });
  if (!found) return fail(found.error());
  if (!*found) return fail(Errc::NotFound, "machine {} is not known", name);
  return std::move(**found);
}

Result<std::vector<Machine>> MachineRepository::list() {
  static const std::string kSql = kSelectMachine + "WHERE removed_us IS NULL ORDER BY name";
  return connections_.read(
      [&](sql::Database& database) { return sql::all_rows(database, kSql, read_machine); });
}

namespace {

/// Whether nothing of it waits or is in progress.
Result<void> check_at_rest(sql::Database& database, const std::string& name, std::int64_t machine) {
  const auto run = sql::first_row(
      database, "SELECT id FROM run WHERE machine = ?1 AND state IN ('ordered', 'active') LIMIT 1",
      [](const sql::Statement& row) { return row.text(0); }, machine);
  if (!run) return fail(run.error());
  if (*run) return fail(Errc::Busy, "machine {} is busy with run {}", name, **run);
  const auto job = sql::first_row(
      database,
      "SELECT job.id FROM job JOIN job_count AS c ON c.job = job.id WHERE job.machine = ?1 AND "
      "job.removed_us IS NULL AND (CASE WHEN job.counts = 'good' THEN c.good ELSE c.made END) < "
      "job.quantity LIMIT 1",
      [](const sql::Statement& row) { return row.integer(0); }, machine);
  if (!job) return fail(job.error());
  if (*job) return fail(Errc::Conflict, "machine {} has a job in its queue: {}", name, **job);
  return {};
}

}  // namespace

Result<void> MachineRepository::remove(const std::string& name, const Actor& who, UtcTime time) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto machine = sql::first_row(
        database, "SELECT id FROM machine WHERE name = ?1 AND removed_us IS NULL",
        [](const sql::Statement& row) { return row.integer(0); }, name);
    if (!machine) return fail(machine.error());
    if (!*machine) return fail(Errc::NotFound, "machine {} is not known", name);
    if (auto rests = check_at_rest(database, name, **machine); !rests) return rests;
    auto removed =
        sql::run(database, "UPDATE machine SET removed_us = ?2 WHERE id = ?1", **machine, time);
    if (!removed) return removed;
    return add_audit(database, {time, who, "machine.remove", name, ""});
  });
}

Result<void> MachineRepository::hold(const MachineHold& hold) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto machine = known_machine(database, hold.machine);
    if (!machine) return fail(machine.error());
    return sql::run(database,
                    "INSERT INTO machine_hold (machine, run, who, reason, since_us) VALUES (?1, "
                    "?2, ?3, ?4, ?5) ON CONFLICT (machine) DO UPDATE SET run = excluded.run, "
                    "who = excluded.who, reason = excluded.reason, since_us = excluded.since_us",
                    *machine, hold.run, hold.who, hold.reason, hold.since);
  });
}

Result<void> MachineRepository::release(const std::string& machine) {
  return connections_.write([&](sql::Database& database) {
    return sql::run(database,
                    "DELETE FROM machine_hold WHERE machine = (SELECT id FROM machine WHERE "
                    "name = ?1)",
                    machine);
  });
}

Result<std::vector<MachineHold>> MachineRepository::holds() {
  return connections_.read([](sql::Database& database) {
    return sql::all_rows(
        database,
        "SELECT machine.name, run, who, reason, since_us FROM machine_hold JOIN machine ON "
        "machine.id = machine_hold.machine ORDER BY machine.name",
        [](const sql::Statement& row) {
          return MachineHold{row.text(0), row.text(1), row.text(2), row.text(3), row.time(4)};
        });
  });
}

}  // namespace dripline::storage
