#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/digest.hpp"
#include "protocol/base/result.hpp"
#include "protocol/base/signature.hpp"
#include "storage/actor.hpp"
#include "storage/programs/program_store.hpp"
#include "storage/programs/revision_state.hpp"

namespace dripline::storage {

/// A revision that a release pins: it is what its program gets for this name, whatever is newer.
struct Pin {
  std::string program;  ///< its name then, under which it is called
  std::uint64_t revision = 0;
  Digest content;
  friend bool operator==(const Pin&, const Pin&) = default;
};

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
  /// Of a release that pins what its program calls: all it may call. Absent: nothing is pinned.
  std::optional<std::vector<Pin>> closure = {};

  static constexpr std::size_t kMaxPins = 256;
};

/// A decision with the state that its revision was seen in.
struct DecisionFrom {
  Decision decision;
  RevisionState from = RevisionState::Draft;
};

/// The states of revisions. Promises of every store: storage/store.hpp.
class ReleaseStore {
 public:
  virtual ~ReleaseStore() = default;

  /// Stores the decision and sets the revision's state; the audit entry (program.submit ...) is
  /// part of the transaction. Errors: NotFound, Conflict (the state is not `from` any more, the
  /// revision is held, its content is another one).
  virtual Result<Revision> decide(const Decision& decision, RevisionState from) = 0;
  /// The same with several, all or none, in their order; returns the last one's revision. What a
  /// release pins must be released by then, with the content that the pin names. Errors: also
  /// LimitExceeded (more than kMaxPins).
  virtual Result<Revision> decide_all(const std::vector<DecisionFrom>& decisions) = 0;
  /// The revisions that a decision pins, in the order of its pins, as they are now: also those of a
  /// program that was renamed or removed since. Errors: Corrupt (one is not there).
  virtual Result<std::vector<Revision>> pinned(std::uint64_t decision) = 0;
  /// Oldest first. Errors: NotFound.
  virtual Result<std::vector<Decision>> decisions(const std::string& program,
                                                  std::uint64_t revision) = 0;
  /// Who pushed these bytes, under whatever name.
  virtual Result<std::set<std::string>> authors(const Digest& content) = 0;
};

}  // namespace dripline::storage
