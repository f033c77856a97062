#include "gateway/app/serial/line_journal.hpp"

namespace dripline::gateway {

report::Progress LineJournal::progress_of(const line::SendProgress& progress) {
  return {.sent = progress.sent.bytes,
          .accepted = progress.is_checked ? progress.sent.blocks : 0,
          .executed = 0,
          .line = progress.sent.line,
          .sequence = progress.sent.sequence,
          .offset = std::max(progress.offered, progress.sent.bytes)};
}

void LineJournal::begin(const std::string& run) {
  const std::lock_guard lock(mutex_);
  run_ = run;
  journal_.begin(run);
}

void LineJournal::write(const line::SendProgress& progress) {
  const std::lock_guard lock(mutex_);
  if (progress.id == run_) journal_.write(progress_of(progress));
}

void LineJournal::clear() {
  const std::lock_guard lock(mutex_);
  run_.clear();
  journal_.clear();
}

std::optional<report::RunJournal::Entry> LineJournal::read() const {
  const std::lock_guard lock(mutex_);
  return journal_.read();
}

}  // namespace dripline::gateway
