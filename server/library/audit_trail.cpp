#include "server/library/audit_trail.hpp"
#include "protocol/process/log.hpp"

namespace dripline::library {

void AuditTrail::write(Change change) {
  const storage::AuditEntry entry{.time = clock_.now(),
                                  .who = std::move(change.who),
                                  .action = std::move(change.action),
                                  .subject = std::move(change.subject),
                                  .detail = std::move(change.detail)};
  if (auto written = store_.add(entry); !written) {
    process::log_error("audit entry lost who={} action={} subject={}: {}", entry.who.name,
                       entry.action, entry.subject, written.error().what);
  }
}

}  // namespace dripline::library
