#pragma once

#include "storage/store.hpp"

namespace dripline::test_support {

/// Passes everything on to another store; a test overrides what should fail.
class StoreDecorator : public storage::Store {
 public:
  explicit StoreDecorator(storage::Store& inner) : inner_(inner) {}

  Result<storage::Upload> begin_upload(const storage::Upload& u) override {
    return inner_.begin_upload(u);
  }
  Result<storage::Upload> upload(const std::string& id) override { return inner_.upload(id); }
  Result<storage::Upload> append_upload(const std::string& id, std::uint64_t offset,
                                        std::span<const std::byte> bytes) override {
    return inner_.append_upload(id, offset, bytes);
  }
  Result<std::vector<std::byte>> read_upload(const std::string& id, std::uint64_t offset,
                                             std::uint64_t length) override {
    return inner_.read_upload(id, offset, length);
  }
  Result<void> set_upload_control(const std::string& id, const std::string& control) override {
    return inner_.set_upload_control(id, control);
  }
  Result<storage::Revision> commit_upload(const std::string& id,
                                          const std::optional<Digest>& expected) override {
    return inner_.commit_upload(id, expected);
  }
  Result<void> abandon_upload(const std::string& id) override { return inner_.abandon_upload(id); }
  Result<std::uint64_t> drop_idle_uploads(std::chrono::seconds passed,
                                          std::chrono::seconds life) override {
    return inner_.drop_idle_uploads(passed, life);
  }
  Result<std::vector<storage::ProgramSummary>> programs(storage::Page page) override {
    return inner_.programs(page);
  }
  Result<std::vector<storage::Revision>> revisions(const std::string& program) override {
    return inner_.revisions(program);
  }
  Result<storage::Revision> revision(const std::string& program,
                                     std::optional<std::uint64_t> number) override {
    return inner_.revision(program, number);
  }
  Result<storage::Revision> accept_revision(const std::string& program, std::uint64_t number,
                                            const std::string& who) override {
    return inner_.accept_revision(program, number, who);
  }
  Result<void> reject_revision(const std::string& program, std::uint64_t number,
                               const std::string& who) override {
    return inner_.reject_revision(program, number, who);
  }
  Result<storage::Revision> copy_program(const storage::ProgramMove& move,
                                         std::optional<std::uint64_t> number) override {
    return inner_.copy_program(move, number);
  }
  Result<void> rename_program(const storage::ProgramMove& move) override {
    return inner_.rename_program(move);
  }
  Result<void> remove_program(const std::string& program) override {
    return inner_.remove_program(program);
  }
  Result<std::vector<std::byte>> read_content(const Digest& content, std::uint64_t offset,
                                              std::uint64_t length) override {
    return inner_.read_content(content, offset, length);
  }
  Result<void> verify_content(const Digest& content) override {
    return inner_.verify_content(content);
  }
  Result<void> save_machine(const storage::Machine& m) override { return inner_.save_machine(m); }
  Result<storage::Machine> machine(const std::string& name) override {
    return inner_.machine(name);
  }
  Result<std::vector<storage::Machine>> machines() override { return inner_.machines(); }
  Result<void> create_run(const storage::Run& run) override { return inner_.create_run(run); }
  Result<storage::Run> run(const std::string& id) override { return inner_.run(id); }
  Result<std::vector<storage::Run>> runs(const storage::RunFilter& filter,
                                         storage::Page page) override {
    return inner_.runs(filter, page);
  }
  Result<void> set_run_state(const std::string& id, storage::RunState state,
                             const std::string& reason) override {
    return inner_.set_run_state(id, state, reason);
  }
  Result<void> update_counters(const std::string& machine, const std::string& id,
                               const storage::Counters& counters, std::uint64_t line,
                               std::int64_t sequence) override {
    return inner_.update_counters(machine, id, counters, line, sequence);
  }
  Result<std::uint64_t> store_records(const storage::RecordBatch& batch) override {
    return inner_.store_records(batch);
  }
  Result<std::vector<storage::MachineReport>> machine_reports() override {
    return inner_.machine_reports();
  }
  Result<std::vector<storage::MemoryReport>> memory_reports(const std::string& machine,
                                                            const std::optional<std::string>& run,
                                                            storage::Page page) override {
    return inner_.memory_reports(machine, run, page);
  }
  Result<std::vector<storage::Record>> machine_report(const std::string& machine,
                                                      storage::Page page) override {
    return inner_.machine_report(machine, page);
  }
  Result<std::vector<storage::Record>> records(const std::string& run, const std::string& kind,
                                               storage::Page page) override {
    return inner_.records(run, kind, page);
  }
  Result<void> save_port(const storage::Port& port) override { return inner_.save_port(port); }
  Result<std::vector<storage::Port>> ports() override { return inner_.ports(); }
  Result<void> remove_port(const std::string& name) override { return inner_.remove_port(name); }
  Result<storage::SetupRevision> save_setup(const storage::SetupRevision& setup,
                                            std::optional<std::uint64_t> base) override {
    return inner_.save_setup(setup, base);
  }
  Result<std::vector<storage::SetupRevision>> setups(const std::string& machine,
                                                     storage::Page page) override {
    return inner_.setups(machine, page);
  }
  Result<storage::SetupRevision> setup(const std::string& machine,
                                       std::optional<std::uint64_t> number) override {
    return inner_.setup(machine, number);
  }
  Result<void> audit(const storage::AuditEntry& entry) override { return inner_.audit(entry); }
  Result<std::vector<storage::AuditEntry>> audit_entries(storage::Page page) override {
    return inner_.audit_entries(page);
  }

 private:
  storage::Store& inner_;
};

}  // namespace dripline::test_support
