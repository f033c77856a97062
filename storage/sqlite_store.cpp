#include "storage/sqlite_store.hpp"

#include "storage/impl/audit_repository.hpp"
#include "storage/impl/machine_repository.hpp"
#include "storage/impl/port_repository.hpp"
#include "storage/impl/program_repository.hpp"
#include "storage/impl/record_repository.hpp"
#include "storage/impl/run_repository.hpp"
#include "storage/impl/setup_repository.hpp"
#include "storage/impl/upload_repository.hpp"
#include "storage/sqlite/deadline.hpp"

namespace dripline::storage {

struct SqliteStore::Repositories {
  Repositories(std::unique_ptr<Connections> opened, const Clock& system_clock,
               std::uint64_t cache_bytes)
      : clock(system_clock),
        connections(std::move(opened)),
        uploads(*connections, clock),
        programs(*connections, cache_bytes),
        machines(*connections),
        runs(*connections, clock),
        records(*connections, clock),
        ports(*connections),
        setups(*connections, clock),
        audit(*connections) {}

  const Clock& clock;
  std::unique_ptr<Connections> connections;
  UploadRepository uploads;
  ProgramRepository programs;
  MachineRepository machines;
  RunRepository runs;
  RecordRepository records;
  PortRepository ports;
  SetupRepository setups;
  AuditRepository audit;
};

Result<std::unique_ptr<SqliteStore>> SqliteStore::open(const SqliteStoreOptions& options,
                                                       const Clock& clock) {
  auto connections = Connections::open(options);
  if (!connections) return fail(connections.error());
  return std::unique_ptr<SqliteStore>(new SqliteStore(
      std::make_unique<Repositories>(std::move(*connections), clock, options.cache_bytes)));
}

SqliteStore::SqliteStore(std::unique_ptr<Repositories> repositories)
    : repositories_(std::move(repositories)) {}
SqliteStore::~SqliteStore() = default;

Result<bool> SqliteStore::check(std::chrono::milliseconds limit, const std::stop_token& stop) {
  return repositories_->connections->read([&](sqlite::Database& database) -> Result<bool> {
    const sqlite::Deadline deadline(database, limit, stop);
    const auto verdict = database.text("PRAGMA quick_check(1)");
    if (deadline.has_passed()) return false;
    if (!verdict) return fail(verdict.error());
    if (*verdict == "ok") return true;
    return fail(Errc::Corrupt, "database {}: {}", database.file(), *verdict);
  });
}

Result<void> SqliteStore::probe() {
  // Its own value again: the page is written and synchronized all the same, and no table is needed.
  std::int64_t id = 0;
  const auto written =
      repositories_->connections->write([&](sqlite::Database& database) -> Result<void> {
        const auto now = database.integer("PRAGMA application_id");
        if (!now) return fail(now.error());
        id = *now;
        return database.execute("PRAGMA application_id = " + std::to_string(id));
      });
  if (!written) return written;
  return repositories_->connections->read([&](sqlite::Database& database) -> Result<void> {
    const auto read = database.integer("PRAGMA application_id");
    if (!read) return fail(read.error());
    const auto tables = database.integer("SELECT COUNT(*) FROM sqlite_schema");
    if (!tables) return fail(tables.error());
    if (*read == id) return {};
    return fail(Errc::Corrupt, "database {} gives another value than was written", database.file());
  });
}

Result<std::string> SqliteStore::identity() {
  return repositories_->connections->read(
      [](sqlite::Database& database) { return database.text("SELECT id FROM identity"); });
}

Result<Upload> SqliteStore::begin_upload(const Upload& upload) {
  return repositories_->uploads.begin(upload);
}
Result<Upload> SqliteStore::upload(const std::string& id) {
  return repositories_->uploads.find(id);
}
Result<Upload> SqliteStore::append_upload(const std::string& id, std::uint64_t offset,
                                          std::span<const std::byte> bytes) {
  return repositories_->uploads.append(id, offset, bytes);
}
Result<std::vector<std::byte>> SqliteStore::read_upload(const std::string& id, std::uint64_t offset,
                                                        std::uint64_t length) {
  return repositories_->uploads.read(id, offset, length);
}
Result<void> SqliteStore::set_upload_control(const std::string& id, const std::string& control) {
  return repositories_->uploads.set_control(id, control);
}
Result<Revision> SqliteStore::commit_upload(const std::string& id,
                                            const std::optional<Digest>& expected) {
  return repositories_->uploads.commit(id, expected);
}
Result<void> SqliteStore::abandon_upload(const std::string& id) {
  return repositories_->uploads.abandon(id);
}
Result<std::uint64_t> SqliteStore::drop_idle_uploads(std::chrono::seconds passed,
                                                     std::chrono::seconds life) {
  return repositories_->uploads.drop_idle(passed, life);
}

Result<std::vector<ProgramSummary>> SqliteStore::programs(Page page) {
  return repositories_->programs.programs(page);
}
Result<std::vector<Revision>> SqliteStore::revisions(const std::string& program) {
  return repositories_->programs.revisions(program);
}
Result<Revision> SqliteStore::revision(const std::string& program,
                                       std::optional<std::uint64_t> number) {
  return repositories_->programs.revision(program, number);
}
Result<Revision> SqliteStore::accept_revision(const std::string& program, std::uint64_t number,
                                              const std::string& who) {
  return repositories_->programs.accept({program, number, who, repositories_->clock.now()});
}
Result<void> SqliteStore::reject_revision(const std::string& program, std::uint64_t number,
                                          const std::string& who) {
  return repositories_->programs.reject({program, number, who, repositories_->clock.now()});
}
Result<Revision> SqliteStore::copy_program(const ProgramMove& move,
                                           std::optional<std::uint64_t> number) {
  return repositories_->programs.copy(move, number, repositories_->clock.now());
}
Result<void> SqliteStore::rename_program(const ProgramMove& move) {
  return repositories_->programs.rename(move, repositories_->clock.now());
}
Result<void> SqliteStore::remove_program(const std::string& program) {
  return repositories_->programs.remove(program);
}
Result<std::vector<std::byte>> SqliteStore::read_content(const Digest& content,
                                                         std::uint64_t offset,
                                                         std::uint64_t length) {
  return repositories_->programs.read_content(content, offset, length);
}
Result<void> SqliteStore::verify_content(const Digest& content) {
  return repositories_->programs.verify_content(content);
}

Result<void> SqliteStore::save_machine(const Machine& machine) {
  return repositories_->machines.save(machine);
}
Result<Machine> SqliteStore::machine(const std::string& name) {
  return repositories_->machines.find(name);
}
Result<std::vector<Machine>> SqliteStore::machines() {
  return repositories_->machines.all();
}

Result<void> SqliteStore::create_run(const Run& run) {
  return repositories_->runs.create(run);
}
Result<Run> SqliteStore::run(const std::string& id) {
  return repositories_->runs.find(id);
}
Result<std::vector<Run>> SqliteStore::runs(const RunFilter& filter, Page page) {
  return repositories_->runs.all(filter, page);
}
Result<void> SqliteStore::set_run_state(const std::string& id, RunState state,
                                        const std::string& reason) {
  return repositories_->runs.set_state(id, state, reason);
}
Result<void> SqliteStore::update_counters(const std::string& machine, const std::string& id,
                                          const Counters& counters, std::uint64_t line,
                                          std::int64_t sequence) {
  return repositories_->runs.update_counters(machine, {id, counters, line, sequence});
}

Result<std::uint64_t> SqliteStore::store_records(const RecordBatch& batch) {
  return repositories_->records.store(batch);
}
Result<std::vector<Record>> SqliteStore::records(const std::string& run, const std::string& kind,
                                                 Page page) {
  return repositories_->records.of_run(run, kind, page);
}
Result<std::vector<MachineReport>> SqliteStore::machine_reports() {
  return repositories_->records.reports();
}
Result<std::vector<MemoryReport>> SqliteStore::memory_reports(const std::string& machine,
                                                              const std::optional<std::string>& run,
                                                              Page page) {
  return repositories_->records.memory(machine, run, page);
}
Result<std::vector<Record>> SqliteStore::machine_report(const std::string& machine, Page page) {
  return repositories_->records.without_run(machine, page);
}

Result<void> SqliteStore::save_port(const Port& port) {
  return repositories_->ports.save(port);
}
Result<std::vector<Port>> SqliteStore::ports() {
  return repositories_->ports.all();
}
Result<void> SqliteStore::remove_port(const std::string& name) {
  return repositories_->ports.remove(name);
}

Result<SetupRevision> SqliteStore::save_setup(const SetupRevision& setup,
                                              std::optional<std::uint64_t> base) {
  return repositories_->setups.save(setup, base);
}
Result<std::vector<SetupRevision>> SqliteStore::setups(const std::string& machine, Page page) {
  return repositories_->setups.all(machine, page);
}
Result<SetupRevision> SqliteStore::setup(const std::string& machine,
                                         std::optional<std::uint64_t> number) {
  return repositories_->setups.find(machine, number);
}

Result<void> SqliteStore::audit(const AuditEntry& entry) {
  return repositories_->audit.add(entry);
}
Result<std::vector<AuditEntry>> SqliteStore::audit_entries(Page page) {
  return repositories_->audit.all(page);
}

}  // namespace dripline::storage
