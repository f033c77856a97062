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
  if (!late_) return write(change);
  const storage::AuditEntry entry{.time = clock_.now(),
                                  .who = change.who,
                                  .action = change.action,
                                  .subject = change.subject,
                                  .detail = change.detail};
  const auto kept = late_->kept.keep(entry);
  if (!kept)
    process::log_warning("an audit entry that waits would not outlive the server: {}",
                         kept.error().what);
  write_late(entry, kept ? *kept : "");
}

void AuditTrail::write_late(const storage::AuditEntry& entry, const std::string& name) {
  const auto add = [&store = store_, &kept = late_->kept, entry, name] {
    auto added = store.add(entry);
    if (added && !name.empty()) kept.drop(name);
    return added;
  };
  late_->writer.write(fmt::format("audit entry who={} action={} subject={}", entry.who.name,
                                  entry.action, entry.subject),
                      add, name.empty() ? LateWriter::AtEnd::Lost : LateWriter::AtEnd::Kept);
}

std::size_t AuditTrail::write_kept() {
  if (!late_) return 0;
  const auto read = late_->kept.read();
  for (const auto& [name, entry] : read.kept) {
    process::log_info("audit entry of a former life of the server: who={} action={} subject={}",
                      entry.who.name, entry.action, entry.subject);
    write_late(entry, name);
  }
  return read.failures;
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
