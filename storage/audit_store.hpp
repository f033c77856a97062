#pragma once

#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"
#include "storage/actor.hpp"
#include "storage/page.hpp"

namespace dripline::storage {

struct AuditEntry {
  UtcTime time;
  Actor who;
  std::string action, subject, detail;
};

/// Promises of every store: storage/store.hpp.
class AuditStore {
 public:
  virtual ~AuditStore() = default;

  virtual Result<void> add(const AuditEntry& entry) = 0;
  /// Newest first.
  virtual Result<std::vector<AuditEntry>> list(Page page) = 0;
};

}  // namespace dripline::storage
