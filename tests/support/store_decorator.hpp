#pragma once

#include "storage/store.hpp"

/// Forward to another store; a test overrides what should fail, and puts it into a Store with
/// `with`.
namespace dripline::test_support {

class ProgramStoreDecorator : public storage::ProgramStore {
 public:
  explicit ProgramStoreDecorator(const storage::Store& inner) : inner_(inner.programs) {}

  using storage::ProgramStore::list;
  Result<std::vector<storage::ProgramSummary>> list(const storage::ProgramFilter& filter,
                                                    storage::Page page) override {
    return inner_.list(filter, page);
  }
  Result<storage::ProgramFields> fields(const std::string& program) override {
    return inner_.fields(program);
  }
  Result<void> describe(const storage::Description& description) override {
    return inner_.describe(description);
  }
  Result<std::uint64_t> count() override { return inner_.count(); }
  Result<std::vector<storage::Revision>> revisions(const std::string& program) override {
    return inner_.revisions(program);
  }
  Result<storage::Revision> revision(const std::string& program,
                                     std::optional<std::uint64_t> number) override {
    return inner_.revision(program, number);
  }
  Result<storage::Revision> accept(const std::string& program, std::uint64_t number,
                                   const storage::Actor& who) override {
    return inner_.accept(program, number, who);
  }
  Result<void> reject(const std::string& program, std::uint64_t number,
                      const storage::Actor& who) override {
    return inner_.reject(program, number, who);
  }
  Result<storage::Revision> copy(const storage::ProgramMove& move,
                                 std::optional<std::uint64_t> number) override {
    return inner_.copy(move, number);
  }
  Result<void> rename(const storage::ProgramMove& move) override { return inner_.rename(move); }
  Result<void> remove(const std::string& program) override { return inner_.remove(program); }
  Result<std::vector<std::byte>> read_content(const Digest& content, std::uint64_t offset,
                                              std::uint64_t length) override {
    return inner_.read_content(content, offset, length);
  }
  std::optional<std::vector<std::byte>> near_content(const Digest& content, std::uint64_t offset,
                                                     std::uint64_t length) override {
    return inner_.near_content(content, offset, length);
  }
  Result<Fetched> fetch_ahead(const Digest& content, std::uint64_t position) override {
    return inner_.fetch_ahead(content, position);
  }
  Result<void> verify_content(const Digest& content) override {
    return inner_.verify_content(content);
  }

 private:
  storage::ProgramStore& inner_;
};

class MachineStoreDecorator : public storage::MachineStore {
 public:
  explicit MachineStoreDecorator(const storage::Store& inner) : inner_(inner.machines) {}

  Result<void> save(const storage::Machine& machine) override { return inner_.save(machine); }
  Result<storage::Machine> find(const std::string& name) override { return inner_.find(name); }
  Result<std::vector<storage::Machine>> list() override { return inner_.list(); }
  Result<void> remove(const std::string& name, const storage::Actor& who, UtcTime time) override {
    return inner_.remove(name, who, time);
  }
  Result<void> hold(const storage::MachineHold& hold) override { return inner_.hold(hold); }
  Result<void> release(const std::string& machine) override { return inner_.release(machine); }
  Result<std::vector<storage::MachineHold>> holds() override { return inner_.holds(); }

 private:
  storage::MachineStore& inner_;
};

class RunStoreDecorator : public storage::RunStore {
 public:
  explicit RunStoreDecorator(const storage::Store& inner) : inner_(inner.runs) {}

  Result<void> create(const storage::Run& run) override { return inner_.create(run); }
  Result<storage::Run> find(const std::string& id) override { return inner_.find(id); }
  Result<std::vector<storage::Run>> list(const storage::RunFilter& filter,
                                         storage::Page page) override {
    return inner_.list(filter, page);
  }
  Result<std::uint64_t> count(const storage::RunFilter& filter) override {
    return inner_.count(filter);
  }
  Result<void> set_state(const std::string& id, storage::RunState state,
                         const std::string& reason) override {
    return inner_.set_state(id, state, reason);
  }
  Result<void> update_counters(const storage::RunProgress& progress) override {
    return inner_.update_counters(progress);
  }
  Result<void> add_call(const std::string& run, const storage::RunCall& call) override {
    return inner_.add_call(run, call);
  }
  Result<std::vector<storage::RunCall>> calls(const std::string& run) override {
    return inner_.calls(run);
  }

 private:
  storage::RunStore& inner_;
};

class RecordStoreDecorator : public storage::RecordStore {
 public:
  explicit RecordStoreDecorator(const storage::Store& inner) : inner_(inner.records) {}

  Result<std::uint64_t> store(const storage::RecordBatch& batch) override {
    return inner_.store(batch);
  }
  Result<std::vector<storage::Record>> of_run(const std::string& run, const std::string& kind,
                                              storage::Page page) override {
    return inner_.of_run(run, kind, page);
  }
  Result<std::vector<storage::Record>> of_run_after(const std::string& run, const std::string& kind,
                                                    storage::RecordPlace after,
                                                    std::uint64_t limit) override {
    return inner_.of_run_after(run, kind, after, limit);
  }
  Result<std::vector<storage::Record>> of_machine_after(const std::string& machine,
                                                        storage::RecordPlace after,
                                                        std::uint64_t limit) override {
    return inner_.of_machine_after(machine, after, limit);
  }
  Result<std::vector<storage::Record>> machine_report(const std::string& machine,
                                                      storage::RecordPlace after,
                                                      std::uint64_t limit) override {
    return inner_.machine_report(machine, after, limit);
  }
  Result<std::vector<storage::MachineReport>> machine_reports() override {
    return inner_.machine_reports();
  }
  Result<std::vector<storage::MemoryReport>> memory_reports(const std::string& machine,
                                                            const std::optional<std::string>& run,
                                                            storage::Page page) override {
    return inner_.memory_reports(machine, run, page);
  }
  Result<std::vector<storage::MemoryReport>> memory_changes(const std::string& machine,
                                                            const std::string& prefix,
                                                            storage::Page page) override {
    return inner_.memory_changes(machine, prefix, page);
  }

 private:
  storage::RecordStore& inner_;
};

/// `store` with one of its parts replaced; the part must outlive it.
inline storage::Store with(const storage::Store& store, storage::ProgramStore& programs) {
  return {programs,           store.uploads,  store.machines,
          store.runs,         store.records,  store.ports,
          store.setups,       store.audit,    store.accounts,
          store.releases,     store.imports,  store.report_templates,
          store.measurements, store.archives, store.offsets,
          store.attachments,  store.search,   store.folders,
          store.jobs,         store.webhooks, store.record_readers};
}
inline storage::Store with(const storage::Store& store, storage::MachineStore& machines) {
  return {store.programs,      store.uploads,  machines,      store.runs,
          store.records,       store.ports,    store.setups,  store.audit,
          store.accounts,      store.releases, store.imports, store.report_templates,
          store.measurements,  store.archives, store.offsets, store.attachments,
          store.search,        store.folders,  store.jobs,    store.webhooks,
          store.record_readers};
}
inline storage::Store with(const storage::Store& store, storage::RunStore& runs) {
  return {store.programs,      store.uploads,  store.machines, runs,
          store.records,       store.ports,    store.setups,   store.audit,
          store.accounts,      store.releases, store.imports,  store.report_templates,
          store.measurements,  store.archives, store.offsets,  store.attachments,
          store.search,        store.folders,  store.jobs,     store.webhooks,
          store.record_readers};
}
inline storage::Store with(const storage::Store& store, storage::RecordStore& records) {
  return {store.programs,     store.uploads,  store.machines,
          store.runs,         records,        store.ports,
          store.setups,       store.audit,    store.accounts,
          store.releases,     store.imports,  store.report_templates,
          store.measurements, store.archives, store.offsets,
          store.attachments,  store.search,   store.folders,
          store.jobs,         store.webhooks, store.record_readers};
}

}  // namespace dripline::test_support
