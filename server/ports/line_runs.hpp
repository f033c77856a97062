#pragma once

#include "server/machines/machine_control.hpp"
#include "server/machines/run_sources.hpp"
#include "server/ports/line_records.hpp"
#include "server/ports/line_types.hpp"

namespace dripline::ports {

/// The runs of machines on lines, as the store has them. What is counted: *sent* bytes that left
/// the line (or were accepted, where the protocol checks), *accepted* blocks the control
/// acknowledged (0 where it cannot), *executed* nothing: a line cannot report it. Any thread, one
/// machine at a time.
class LineRuns {
 public:
  explicit LineRuns(const machines::RunSources& sources)
      : sources_(sources), store_(sources.store), clock_(sources.clock) {}

  /// A run that is Ordered. Errors: NotFound, Unsupported (the program is for another control),
  /// Conflict (nothing but held revisions, or nothing that may run there), Busy (the machine has a
  /// run).
  Result<storage::Run> create(const machines::StartRequest& request,
                              const storage::Machine& machine);
  /// What is to be sent for it. Reads the program up to there. Errors: NotFound (no such line,
  /// byte, N number or tool), Conflict (the rest relies on words before it), Corrupt.
  Result<SendJob> job(const storage::Run& run, const machines::StartRequest& request);

  void started(const storage::Run& run, LineRecords& records);
  /// Refused; nothing of it has left.
  void refused(const storage::Run& run, const Error& error);
  void progressed(const std::string& machine, const SendProgress& progress);
  void ended(const SendEnd& end, LineRecords& records, std::function<void()> stored = {});
  /// Runs of a former life of the server: they end Interrupted, with the counters of the store.
  Result<void> give_up_unfinished(const std::string& machine, LineRecords& records);

 private:
  const machines::RunSources sources_;
  const storage::Store& store_;
  const Clock& clock_;
};

}  // namespace dripline::ports
