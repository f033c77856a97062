#include "server/library/history/run_history.hpp"

namespace dripline::library {

Result<std::vector<storage::Record>> RunHistory::records(const std::string& run,
                                                         const std::string& kind,
                                                         storage::Page page) {
  const auto found = store_.runs.find(run);
  if (!found) return fail(found.error());
  return store_.records.of_run(found->id, kind, page);
}

Result<std::shared_ptr<ReportReader>> RunHistory::report(const std::string& run,
                                                         ReportFormat format) {
  auto found = store_.runs.find(run);
  if (!found) return fail(found.error());
  return std::make_shared<ReportReader>(store_.records, *std::move(found), format);
}

Result<std::shared_ptr<ReportReader>> RunHistory::machine_report(const std::string& machine,
                                                                 ReportFormat format) {
  const auto found = store_.machines.find(machine);
  if (!found) return fail(found.error());
  return std::make_shared<ReportReader>(store_.records, found->name, format);
}

}  // namespace dripline::library
