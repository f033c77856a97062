#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/audit/chain.hpp"
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

/// An entry as it is stored, and the digest that is stored with it.
struct ChainedEntry {
  audit::Entry entry;
  Digest digest;
  std::string run_fault;  ///< of the end of a run (action run.end): how the run differs from it
};

/// Who did what: one hash chain (protocol/audit) over the entries. The end of a run is an entry
/// too, written in the transaction that ends the run. Promises of every store: storage/store.hpp.
class AuditStore {
 public:
  virtual ~AuditStore() = default;

  virtual Result<void> add(const AuditEntry& entry) = 0;
  /// Newest first.
  virtual Result<std::vector<AuditEntry>> list(Page page) = 0;

  /// In the order of their numbers, those after `after`.
  virtual Result<std::vector<ChainedEntry>> chained(std::uint64_t after, std::uint64_t limit) = 0;
  virtual Result<std::vector<audit::Checkpoint>> checkpoints(std::uint64_t after,
                                                             std::uint64_t limit) = 0;
  /// Errors: Conflict (its number was used).
  virtual Result<void> add_checkpoint(const audit::Checkpoint& checkpoint) = 0;
  /// The entry of the end of a run; absent: it has none.
  virtual Result<std::optional<ChainedEntry>> run_end(const std::string& run) = 0;
  /// A run that has ended, but has no entry of its end.
  virtual Result<std::optional<std::string>> run_without_end() = 0;
};

}  // namespace dripline::storage
