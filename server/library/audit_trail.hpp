#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "protocol/base/clock.hpp"
#include "server/library/late_writer.hpp"
#include "server/library/waiting_entries.hpp"
#include "storage/audit_store.hpp"

namespace dripline::library {

/// Who did what. Any thread.
class AuditTrail {
 public:
  /// Who writes late, and where it is kept until then.
  struct Late {
    LateWriter& writer;
    WaitingEntries& kept;
  };
  /// Without `late` nothing is written late.
  AuditTrail(storage::AuditStore& store, const Clock& clock, std::optional<Late> late = {})
      : store_(store), clock_(clock), late_(late) {}

  struct Change {
    storage::Actor who;
    std::string action, subject, detail;
  };
  /// Of a change that was made: an entry that cannot be written is logged as an error and does not
  /// undo it.
  void write(Change change);
  /// Of a machine that was stopped: written when the store is there again, by the server's next
  /// life if need be, with the present time.
  void write_late(const Change& change);
  /// What a former life of the server could not write. Returns how many of it cannot be read.
  std::size_t write_kept();
  /// Of what is about to be done. Errors: those of the store; then it must not be done.
  Result<void> write_before(Change change);
  Result<std::vector<storage::AuditEntry>> entries(storage::Page page) { return store_.list(page); }

 private:
  /// `name`: of the kept entry, may be empty.
  void write_late(const storage::AuditEntry& entry, const std::string& name);

  storage::AuditStore& store_;
  const Clock& clock_;
  const std::optional<Late> late_;
};

}  // namespace dripline::library
