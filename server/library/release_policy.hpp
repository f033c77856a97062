#pragma once

#include <array>
#include <set>
#include <string>
#include <string_view>

#include "protocol/base/digest.hpp"
#include "storage/account_store.hpp"
#include "storage/programs/revision_state.hpp"

namespace dripline::library {

/// What a policy may accept from a machine unseen (clients/tools/comparison, "The class of an
/// edit"). A path that changed, and what is not known, is for a person.
inline constexpr std::array<std::string_view, 4> kAtOnceClasses{"comment", "same_motion",
                                                                "feed_and_speed", "offsets"};

/// From which states a step may be taken, and by whom.
struct StepRule {
  std::set<storage::RevisionState> from;
  storage::Role role = storage::Role::Approver;  ///< at least
  bool needs_four_eyes = false;                  ///< not by who pushed these bytes
  bool needs_comment = false;
};

/// What machines may run, and how a revision becomes that. A value. Its keys:
/// - `runs`: "release" (released revisions only) or "open" (the default: what is pushed).
/// - `[prove_out]`: `machines` run drafts too, when a person of at least `role` starts them.
/// - `[submit]`, `[approve]`, `[reject]`, `[release]`, `[withdraw]`: `from` (states), `role`,
///   `four_eyes`, `comment`.
/// - `[imports]`: `accept_at_once`, classes of edits (kAtOnceClasses) with which a revision from a
///   machine is accepted without a person; the default is none.
/// An example with all of them: deploy/examples/policy.toml.
struct ReleasePolicy {
  bool runs_released_only = false;
  std::set<std::string> prove_out_machines;
  storage::Role prove_out_role = storage::Role::Programmer;
  std::array<StepRule, storage::kRevisionSteps> rules;
  std::set<std::string> accept_at_once;  ///< classes of edits
  Digest digest;                         ///< of the text it was read from

  const StepRule& rule(storage::RevisionStep step) const {
    return rules.at(static_cast<std::size_t>(step));
  }

  /// An empty text is the default. Errors: Syntax (also an unknown key, a state from which the step
  /// makes no sense, a role below the one that the API asks for); they name key and line.
  static Result<ReleasePolicy> parse(std::string_view toml);
  /// An empty name is the default. Errors: NotFound, Denied (it is not understood: key and line).
  static Result<ReleasePolicy> read(const std::string& file);
};

}  // namespace dripline::library
