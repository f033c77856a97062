#pragma once

#include <string>

#include "protocol/base/clock.hpp"
#include "storage/audit_store.hpp"

namespace dripline::library {

/// Who did what. Any thread.
class AuditTrail {
 public:
  AuditTrail(storage::AuditStore& store, const Clock& clock) : store_(store), clock_(clock) {}

  struct Change {
    storage::Actor who;
    std::string action, subject, detail;
  };
  /// Of a change that was made: an entry that cannot be written is logged as an error and does not
  /// undo it.
  void write(Change change);
  /// Of what is about to be done. Errors: those of the store; then it must not be done.
  Result<void> write_before(Change change);
  Result<std::vector<storage::AuditEntry>> entries(storage::Page page) { return store_.list(page); }

 private:
  storage::AuditStore& store_;
  const Clock& clock_;
};

}  // namespace dripline::library
