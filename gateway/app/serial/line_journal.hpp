#pragma once

#include <mutex>
#include <string>

#include "gateway/line/line_session.hpp"
#include "gateway/report/run_journal.hpp"

namespace dripline::gateway {

/// The run journal of a run over a line. It is written on the line's thread before more may leave
/// and when more was sent, so that after a kill the truth lies between two numbers: `sent`, and
/// `offset`, the bytes that may have left. Any thread.
class LineJournal {
 public:
  /// The journal must outlive it.
  explicit LineJournal(report::RunJournal& journal) : journal_(journal) {}

  void begin(const std::string& run);
  void write(const line::SendProgress& progress);
  void clear();
  std::optional<report::RunJournal::Entry> read() const;
  /// Waits for the disk. Errors: Io.
  Result<void> sync() { return journal_.sync(); }

  static report::Progress progress_of(const line::SendProgress& progress);

 private:
  mutable std::mutex mutex_;
  report::RunJournal& journal_;
  std::string run_;
};

}  // namespace dripline::gateway
