#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/signature.hpp"
#include "server/library/parameter_numbering.hpp"
#include "server/library/program_closure.hpp"
#include "server/library/release_policy.hpp"
#include "storage/store.hpp"

namespace dripline::library {

/// What is signed of a decision: everything that was stored of it, and the database it is in.
std::string decision_text(const storage::Decision& decision, const std::string& database);

/// Decides which revision a machine gets, and takes revisions through their states. Every decision
/// is signed with the server's key, and a run of a released revision begins only when all of them
/// verify. Whatever opens a program for a machine asks here: starts, restarts, requests from
/// controls, transfers, and the programs that a run calls. Any thread.
class Releases {
 public:
  struct Parts {
    const storage::Store& store;
    const Clock& clock;
    SigningKey key;
    std::string database;  ///< its identity
  };
  Releases(Parts parts, ReleasePolicy policy)
      : parts_(std::move(parts)), policy_(std::move(policy)), numbering_(parts_.store.programs) {}
  const ReleasePolicy& policy() const { return policy_; }
  const PublicKey& public_key() const { return parts_.key.public_key(); }

  struct Request {
    std::string program;
    std::uint64_t revision = 0;
    storage::RevisionStep step = storage::RevisionStep::Submit;
    std::string comment;
    storage::Actor who = {};
    storage::Role role = storage::Role::Viewer;
    /// Of a release: what the program calls is pinned, and released with it where it is not yet.
    std::optional<Closure> closure = {};
  };
  /// Errors: NotFound, Denied (the role, four eyes), Conflict (not from this state, held; something
  /// of the closure is missing or cannot be released), Syntax (no comment), LimitExceeded (its
  /// length).
  Result<storage::Revision> decide(const Request& request);
  /// What is signed of it.
  std::string text_of(const storage::Decision& decision) const {
    return decision_text(decision, parts_.database);
  }
  /// Oldest first. Errors: NotFound.
  Result<std::vector<storage::Decision>> decisions(const std::string& program,
                                                   std::uint64_t revision) {
    return parts_.store.releases.decisions(program, revision);
  }

  /// A revision with what a run of it would call now. Errors: those of closure_of.
  Result<Closure> closure(ClosureRequest request) {
    request.prefers_released = policy_.runs_released_only;
    return closure_of(parts_.store, request);
  }

  struct Wish {
    std::string machine, program;
    std::optional<std::uint64_t> revision = {};  ///< absent: the latest that the machine may run
    storage::Role role = storage::Role::Viewer;  ///< of who asks; a control has none
  };
  struct Admission {
    storage::Revision revision;
    storage::RunAllowance allowed_as = storage::RunAllowance::Open;
    /// The decision that released it, where a release is needed or pins what is called.
    std::optional<std::uint64_t> approval = {};
  };
  /// Errors: NotFound, Conflict (nothing of it may run there: its state is named; it was released
  /// under another name; what its release pins was withdrawn), Corrupt (a decision is not signed by
  /// this server, or they contradict the state), Unsupported (check_numbering).
  Result<Admission> admit(const Wish& wish);
  /// Of what a run calls. Errors: those of ParameterNumbering.
  Result<void> check_numbering(const storage::Revision& revision) {
    return numbering_.check(revision);
  }
  /// What a request from the machine's control gets of a program; absent: nothing of it.
  std::optional<storage::Revision> offered(const storage::ProgramSummary& program,
                                           const std::string& machine);
  /// Whether a run may call this revision. Judged as of the run's beginning, so that a run keeps
  /// what it began with, and by the store's order: clocks are set, and those of two servers differ.
  static bool may_call(const storage::Revision& revision, const storage::Run& run);
  /// Of one that it may call. Errors: Corrupt, Conflict (released under another name).
  Result<void> check_call(const storage::Revision& revision, const storage::Run& run);

  /// What a run under a release that pins its calls gets for any of these names, the most literal
  /// first; nothing when the release pins nothing. Errors: NotFound (it pins none of the names),
  /// Corrupt (as of admit).
  Result<std::optional<storage::Revision>> pinned_call(const storage::Run& run,
                                                       const std::vector<std::string>& names);

  static constexpr std::size_t kMaxComment = 1024;

 private:
  /// Again: by a run that began before it was withdrawn.
  enum class Asked : std::uint8_t { Anew, Again };
  bool proves_out(const Wish& wish) const;
  Result<storage::Revision> wanted(const Wish& wish);
  Result<storage::Decision> verify(const storage::Revision& revision, Asked asked);
  Result<storage::DecisionFrom> decision(const Request& request, const storage::Revision& revision);
  Result<storage::Revision> release_together(const Request& request, storage::DecisionFrom main);
  Result<Admission> admit_by_state(const Wish& wish);
  Result<Admission> admit_released(storage::Revision revision);
  Result<void> check_pins(const storage::Decision& release);

  Parts parts_;
  const ReleasePolicy policy_;
  ParameterNumbering numbering_;
};

}  // namespace dripline::library
