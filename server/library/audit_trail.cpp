#include "server/library/audit_trail.hpp"
#include "protocol/process/log.hpp"

namespace dripline::library {

void AuditTrail::write(Change change) {
  if (auto written = write_before(change); !written) {
    process::log_error("audit entry lost who={} action={} subject={}: {}", change.who.name,
                       change.action, change.subject, written.error().what);
  }
}

void AuditTrail::write_late(const Change& change) {
  if (late_ == nullptr) return write(change);
  const storage::AuditEntry entry{.time = clock_.now(),
                                  .who = change.who,
                                  .action = change.action,
                                  .subject = change.subject,
                                  .detail = change.detail};
  late_->write(fmt::format("audit entry who={} action={} subject={}", change.who.name,
                           change.action, change.subject),
               [&store = store_, entry] { return store.add(entry); });
}

Result<void> AuditTrail::write_before(Change change) {
  auto written = store_.add({.time = clock_.now(),
                             .who = std::move(change.who),
                             .action = std::move(change.action),
                             .subject = std::move(change.subject),
                             .detail = std::move(change.detail)});
  if (written) return written;
  return fail(written.error().code, "the audit trail cannot be written, so nothing is done: {}",
              written.error().what);
}

}  // namespace dripline::library
