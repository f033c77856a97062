#include "server/machines/record_writer.hpp"

#include <algorithm>
#include <utility>
#include "protocol/process/log.hpp"

namespace dripline::machines {

Result<std::uint64_t> RecordWriter::store(const storage::RecordBatch& batch) {
  auto stored = parts_.store.store(batch);
  if (!stored && is_hopeless(stored.error())) return stored;
  std::chrono::milliseconds before{};
  {
    const std::lock_guard lock(mutex_);
    before = pause_;
    pause_ =
        stored ? std::chrono::milliseconds{0} : std::clamp(pause_ * 2, kFirstPause, kLongestPause);
  }
  if (!stored) {
    if (before.count() == 0) {
      process::log_error("records cannot be stored, {} machine={}: {}", parts_.consequence,
                         parts_.machine, stored.error().what);
    }
    if (parts_.on_fault) parts_.on_fault(stored.error().what);
  } else if (before.count() > 0) {
    process::log_info("records are stored again machine={}", parts_.machine);
    if (parts_.on_fault) parts_.on_fault("");
  }
  return stored;
}

std::chrono::milliseconds RecordWriter::pause() const {
  const std::lock_guard lock(mutex_);
  return pause_;
}

}  // namespace dripline::machines
