#pragma once

#include <memory>

#include "server/library/history/kept_memory.hpp"
#include "server/library/history/report_reader.hpp"
#include "server/library/history/run_facts.hpp"
#include "storage/store.hpp"

namespace dripline::library {

/// The stored runs, and what machines reported during and outside them. Any thread.
class RunHistory {
 public:
  explicit RunHistory(const storage::Store& store) : store_(store) {}

  /// Errors: NotFound.
  Result<storage::Run> run(const std::string& id) { return store_.runs.find(id); }
  /// Newest first.
  Result<std::vector<storage::Run>> runs(const storage::RunFilter& filter, storage::Page page) {
    return store_.runs.list(filter, page);
  }
  Result<std::uint64_t> count(const storage::RunFilter& filter) {
    return store_.runs.count(filter);
  }
  /// In order of (epoch, number). `kind` empty: all. Errors: NotFound.
  Result<std::vector<storage::Record>> records(const std::string& run, const std::string& kind,
                                               storage::Page page);

  /// See facts_of_run.
  Result<std::vector<audit::Fact>> facts(const std::string& run, const std::string& database) {
    return facts_of_run(store_, run, database);
  }

  /// The report lines of a run. The store must outlive the reader. Errors: NotFound.
  Result<std::shared_ptr<ReportReader>> report(const std::string& run, ReportFormat format);
  /// The lines that a machine printed outside any run. Errors: NotFound.
  Result<std::shared_ptr<ReportReader>> machine_report(const std::string& machine,
                                                       ReportFormat format);
  Result<std::vector<storage::MachineReport>> machine_reports() {
    return store_.records.machine_reports();
  }
  /// What the machine's control retained after its runs; see kept_memories.
  Result<std::vector<KeptMemory>> memories(const std::string& machine,
                                           const std::optional<std::string>& run,
                                           storage::Page page) {
    return kept_memories(store_, machine, run, page);
  }

 private:
  const storage::Store& store_;
};

}  // namespace dripline::library
