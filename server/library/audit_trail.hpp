#pragma once

#include <string>

#include "protocol/base/clock.hpp"
#include "server/library/late_writer.hpp"
#include "storage/audit_store.hpp"

namespace dripline::library {

/// Who did what. Any thread.
class AuditTrail {
 public:
  /// `late`: null: nothing is written late.
  AuditTrail(storage::AuditStore& store, const Clock& clock, LateWriter* late = nullptr)
      : store_(store), clock_(clock), late_(late) {}

  struct Change {
    storage::Actor who;
    std::string action, subject, detail;
  };
  /// Of a change that was made: an entry that cannot be written is logged as an error and does not
  /// undo it.
  void write(Change change);
  /// Of a machine that was stopped: written when the store is there again, with the present time.
  void write_late(const Change& change);
  /// Of what is about to be done. Errors: those of the store; then it must not be done.
  Result<void> write_before(Change change);
  Result<std::vector<storage::AuditEntry>> entries(storage::Page page) { return store_.list(page); }

 private:
  storage::AuditStore& store_;
  const Clock& clock_;
  LateWriter* const late_;
};

}  // namespace dripline::library
