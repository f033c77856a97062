#pragma once

#include "storage/impl/audit_repository.hpp"
#include "storage/impl/connections.hpp"
#include "storage/machine_store.hpp"
#include "storage/port_store.hpp"
#include "storage/record_store.hpp"
#include "storage/run_store.hpp"
#include "storage/setup_store.hpp"
#include "storage/sql/database.hpp"

/// The repositories without a state of their own; each has a .cpp with its SQL. Thread-safe.

namespace dripline::storage {

/// Inside the caller's transaction: the machine's row id, made when it is new (a gateway's records
/// may come before its announcement). Errors: Syntax and LimitExceeded for a new name.
Result<std::int64_t> machine_id(sql::Database& database, const std::string& name,
                                std::uint64_t epoch, UtcTime now);

/// The same of one that is there. Errors: NotFound.
Result<std::int64_t> known_machine(sql::Database& database, const std::string& name);

class MachineRepository final : public MachineStore {
 public:
  explicit MachineRepository(Connections& connections) : connections_(connections) {}

  Result<void> save(const Machine& machine) override;
  Result<Machine> find(const std::string& name) override;
  Result<std::vector<Machine>> list() override;
  Result<void> remove(const std::string& name, const Actor& who, UtcTime time) override;
  Result<void> hold(const MachineHold& hold) override;
  Result<void> release(const std::string& machine) override;
  Result<std::vector<MachineHold>> holds() override;

 private:
  Connections& connections_;
};

class PortRepository final : public PortStore {
 public:
  explicit PortRepository(Connections& connections) : connections_(connections) {}

  Result<void> save(const Port& port) override;
  Result<std::vector<Port>> list() override;
  Result<void> remove(const std::string& name) override;
  Result<void> save_transfer(const PortTransfer& transfer) override;
  Result<void> note_progress(const PortTransfer& transfer) override;
  Result<void> drop_transfer(const PortTransfer& transfer) override;
  Result<std::vector<PortTransfer>> transfers(const std::string& port) override;

 private:
  Connections& connections_;
};

class RecordRepository final : public RecordStore {
 public:
  RecordRepository(Connections& connections, const Clock& clock)
      : connections_(connections), clock_(clock) {}

  Result<std::uint64_t> store(const RecordBatch& batch) override;
  std::vector<Result<std::uint64_t>> store_all(const std::vector<RecordBatch>& batches) override;
  Result<std::vector<Record>> of_run(const std::string& run, const std::string& kind,
                                     Page page) override;
  Result<std::vector<Record>> of_run_after(const std::string& run, const std::string& kind,
                                           RecordPlace after, std::uint64_t limit) override;
  Result<std::vector<Record>> of_machine_after(const std::string& machine, RecordPlace after,
                                               std::uint64_t limit) override;
  Result<std::vector<Record>> machine_report(const std::string& machine, RecordPlace after,
                                             std::uint64_t limit) override;
  Result<std::vector<MachineReport>> machine_reports() override;
  Result<std::vector<MemoryReport>> memory_reports(const std::string& machine,
                                                   const std::optional<std::string>& run,
                                                   Page page) override;
  Result<std::vector<MemoryReport>> memory_changes(const std::string& machine,
                                                   const std::string& prefix, Page page) override;

 private:
  Result<std::vector<MemoryReport>> memory_reports_of(const std::string& machine,
                                                      const std::optional<std::string>& run,
                                                      const std::string& prefix, Page page);

  Connections& connections_;
  const Clock& clock_;
};

class RunRepository final : public RunStore {
 public:
  RunRepository(Connections& connections, const Clock& clock)
      : connections_(connections), clock_(clock) {}

  Result<void> create(const Run& run) override;
  Result<Run> find(const std::string& id) override;
  Result<std::vector<Run>> list(const RunFilter& filter, Page page) override;
  Result<std::uint64_t> count(const RunFilter& filter) override;
  Result<void> set_state(const std::string& id, RunState state, const std::string& reason) override;
  Result<void> update_counters(const RunProgress& progress) override;
  std::vector<Result<void>> update_all_counters(
      const std::vector<RunProgress>& progresses) override;
  Result<void> add_call(const std::string& run, const RunCall& call) override;
  Result<std::vector<RunCall>> calls(const std::string& run) override;

 private:
  Connections& connections_;
  const Clock& clock_;
};

class SetupRepository final : public SetupStore {
 public:
  SetupRepository(Connections& connections, const Clock& clock)
      : connections_(connections), clock_(clock) {}

  Result<SetupRevision> save(const SetupRevision& setup,
                             std::optional<std::uint64_t> base) override;
  Result<std::vector<SetupRevision>> list(const std::string& machine, Page page) override;
  Result<SetupRevision> find(const std::string& machine,
                             std::optional<std::uint64_t> number) override;
  Result<LoadedSetup> note_loaded(const std::string& machine, std::optional<std::uint64_t> number,
                                  const Actor& who) override;
  Result<std::optional<LoadedSetup>> loaded(const std::string& machine) override;

 private:
  Connections& connections_;
  const Clock& clock_;
};

// How records change runs, inside the transaction that stores the records. Only the runs of the
// machine that reports are changed.

/// Ordered becomes Active. Unknown and other runs stay as they are: a record is never refused for
/// what it reports of a run.
Result<void> apply_beginning(sql::Database& database, std::int64_t machine,
                             const RunBeginning& beginning);

/// An unfinished run gets its final state; a finished one keeps the state it has. Counters never go
/// back. Errors: Syntax (the ending's state is none that ends).
Result<void> apply_ending(sql::Database& database, std::int64_t machine, const RunEnding& ending);

struct NewOutputs {
  std::string run;
  std::uint64_t count = 0;
};
Result<void> add_outputs(sql::Database& database, std::int64_t machine, const NewOutputs& outputs);

}  // namespace dripline::storage
