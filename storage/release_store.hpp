#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/digest.hpp"
#include "protocol/base/result.hpp"
#include "protocol/base/signature.hpp"
#include "storage/actor.hpp"
#include "storage/program_store.hpp"
#include "storage/revision_state.hpp"

namespace dripline::storage {

/// A step that was taken: who decided what about which bytes.
struct Decision {
  std::uint64_t id = 0;  ///< 1, 2, 3 ... in their order; the store gives it
  std::string program;   ///< its name then
  std::uint64_t revision = 0;
  Digest content;
  RevisionStep step = RevisionStep::Submit;
  UtcTime time;
  Actor who;
  std::string comment;
  Digest policy;  ///< SHA-256 of the policy's text that was in force
  Signature signature;
};

/// The states of revisions. Promises of every store: storage/store.hpp.
class ReleaseStore {
 public:
  virtual ~ReleaseStore() = default;

  /// Stores the decision and sets the revision's state; the audit entry (program.submit ...) is
  /// part of the transaction. Errors: NotFound, Conflict (the state is not `from` any more, the
  /// revision is held, its content is another one).
  virtual Result<Revision> decide(const Decision& decision, RevisionState from) = 0;
  /// Oldest first. Errors: NotFound.
  virtual Result<std::vector<Decision>> decisions(const std::string& program,
                                                  std::uint64_t revision) = 0;
  /// Who pushed these bytes, under whatever name.
  virtual Result<std::set<std::string>> authors(const Digest& content) = 0;
};

}  // namespace dripline::storage
