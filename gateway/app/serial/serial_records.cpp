#include "gateway/app/serial/serial_records.hpp"

#include <utility>

#include "gateway/app/run/run_texts.hpp"
#include "protocol/process/log.hpp"

namespace dripline::gateway {
namespace {

constexpr std::chrono::milliseconds kRetry{500};

}  // namespace

void SerialRecords::append(Entry entry) {
  dds::Record record;
  record.machine = parts_.machine;
  record.time = parts_.clock.now();
  record.run = std::move(entry.run);
  record.kind = entry.kind;
  record.device = std::move(entry.device);
  record.text = valid_text(entry.text, dds::kMaxRecordText);
  parts_.outbox.append(std::move(record));
}

Result<void> SerialRecords::commit() {
  const auto done = parts_.outbox.commit();
  if (!done) {
    if (fault_.empty())
      process::log_error("reports cannot be kept: {} machine={}", done.error().what,
                         parts_.machine);
    fault_ = done.error().what;
    next_try_ = parts_.clock.steady_now() + kRetry;
    return done;
  }
  if (!std::exchange(fault_, {}).empty())
    process::log_info("reports are kept again machine={}", parts_.machine);
  for (auto& kept : std::exchange(kept_, {})) kept();
  return {};
}

void SerialRecords::poll(SteadyTime now) {
  if (!fault_.empty() && now >= next_try_) (void)commit();
}

void SerialRecords::discard() {
  parts_.outbox.discard();
  fault_.clear();
}

}  // namespace dripline::gateway
