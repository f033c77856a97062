#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <stop_token>

#include "protocol/base/clock.hpp"
#include "storage/store.hpp"

namespace dripline::storage {

struct SqliteStoreOptions {
  std::filesystem::path file;           ///< created when missing; its folder must exist
  std::uint64_t max_bytes = 0;          ///< the database never grows beyond; 0 = as the disk allows
  std::size_t readers = 4;              ///< connections that read at the same time
  std::uint64_t cache_bytes = 8 << 20;  ///< of program chunks kept checked and decompressed
  std::chrono::milliseconds wait{10000};  ///< at most for a connection, then Errc::Busy
};

/// The first Store: one SQLite file. Writes one at a time on one connection, each on disk when it
/// returns (but see update_counters); reads beside them, each of one consistent picture.
/// One process uses a file at a time.
class SqliteStore final : public Store {
 public:
  /// Creates or migrates the file. `clock` must outlive the store. Errors: Busy (another process
  /// uses the file), Unsupported (a newer version's file), Corrupt, Io.
  static Result<std::unique_ptr<SqliteStore>> open(const SqliteStoreOptions& options,
                                                   const Clock& clock);
  ~SqliteStore() override;

  /// Looks through the whole file for damage of its structure (not of program content, which is
  /// checked whenever it is read), for at most `limit` or until `stop`. False: that was not
  /// enough; so far all is well. Reads and writes go on beside it. Errors: Corrupt.
  Result<bool> check(std::chrono::milliseconds limit = std::chrono::hours(24),
                     const std::stop_token& stop = {});
  /// Writes something small onto the disk, and reads it. Errors: Io (a full disk), Corrupt, Busy.
  Result<void> probe();
  /// Made when the database was, the same for ever: 32 hexadecimal digits.
  Result<std::string> identity();

  Result<Upload> begin_upload(const Upload& upload) override;
  Result<Upload> upload(const std::string& id) override;
  Result<Upload> append_upload(const std::string& id, std::uint64_t offset,
                               std::span<const std::byte> bytes) override;
  Result<std::vector<std::byte>> read_upload(const std::string& id, std::uint64_t offset,
                                             std::uint64_t length) override;
  Result<void> set_upload_control(const std::string& id, const std::string& control) override;
  Result<Revision> commit_upload(const std::string& id,
                                 const std::optional<Digest>& expected) override;
  Result<void> abandon_upload(const std::string& id) override;
  Result<std::uint64_t> drop_idle_uploads(std::chrono::seconds passed,
                                          std::chrono::seconds life) override;

  Result<std::vector<ProgramSummary>> programs(Page page) override;
  Result<std::vector<Revision>> revisions(const std::string& program) override;
  Result<Revision> revision(const std::string& program,
                            std::optional<std::uint64_t> number) override;
  Result<Revision> accept_revision(const std::string& program, std::uint64_t number,
                                   const std::string& who) override;
  Result<void> reject_revision(const std::string& program, std::uint64_t number,
                               const std::string& who) override;
  Result<Revision> copy_program(const ProgramMove& move,
                                std::optional<std::uint64_t> number) override;
  Result<void> rename_program(const ProgramMove& move) override;
  Result<void> remove_program(const std::string& program) override;
  Result<std::vector<std::byte>> read_content(const Digest& content, std::uint64_t offset,
                                              std::uint64_t length) override;
  Result<void> verify_content(const Digest& content) override;

  Result<void> save_machine(const Machine& machine) override;
  Result<Machine> machine(const std::string& name) override;
  Result<std::vector<Machine>> machines() override;

  Result<void> create_run(const Run& run) override;
  Result<Run> run(const std::string& id) override;
  Result<std::vector<Run>> runs(const RunFilter& filter, Page page) override;
  Result<void> set_run_state(const std::string& id, RunState state,
                             const std::string& reason) override;
  Result<void> update_counters(const std::string& machine, const std::string& id,
                               const Counters& counters, std::uint64_t line,
                               std::int64_t sequence) override;

  Result<std::uint64_t> store_records(const RecordBatch& batch) override;
  Result<std::vector<MachineReport>> machine_reports() override;
  Result<std::vector<Record>> machine_report(const std::string& machine, Page page) override;
  Result<std::vector<MemoryReport>> memory_reports(const std::string& machine,
                                                   const std::optional<std::string>& run,
                                                   Page page) override;
  Result<std::vector<Record>> records(const std::string& run, const std::string& kind,
                                      Page page) override;

  Result<void> save_port(const Port& port) override;
  Result<std::vector<Port>> ports() override;
  Result<void> remove_port(const std::string& name) override;

  Result<SetupRevision> save_setup(const SetupRevision& setup,
                                   std::optional<std::uint64_t> base) override;
  Result<std::vector<SetupRevision>> setups(const std::string& machine, Page page) override;
  Result<SetupRevision> setup(const std::string& machine,
                              std::optional<std::uint64_t> number) override;

  Result<void> audit(const AuditEntry& entry) override;
  Result<std::vector<AuditEntry>> audit_entries(Page page) override;

 private:
  struct Repositories;
  explicit SqliteStore(std::unique_ptr<Repositories> repositories);
  std::unique_ptr<Repositories> repositories_;
};

}  // namespace dripline::storage
