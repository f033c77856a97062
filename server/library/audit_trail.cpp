#include "server/library/audit_trail.hpp"
#include "protocol/process/log.hpp"

namespace dripline::library {

void AuditTrail::write(Change change) {
  if (auto written = write_before(change); !written) {
    process::log_error("audit entry lost who={} action={} subject={}: {}", change.who.name,
                       change.action, change.subject, written.error().what);
  }
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
