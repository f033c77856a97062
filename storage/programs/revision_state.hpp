#pragma once

#include <cstdint>
#include <string_view>

#include "protocol/base/result.hpp"

namespace dripline::storage {

/// The life of a revision. A draft was pushed; a withdrawn one never runs again.
enum class RevisionState : std::uint8_t { Draft, InReview, Approved, Released, Withdrawn };
std::string_view to_string(RevisionState state);
/// Errors: Syntax (names the known ones).
Result<RevisionState> parse_revision_state(std::string_view text);

/// What takes a revision from one state to another.
enum class RevisionStep : std::uint8_t { Submit, Approve, Reject, Release, Withdraw };
inline constexpr std::size_t kRevisionSteps = 5;
std::string_view to_string(RevisionStep step);
/// Errors: Syntax (names the known ones).
Result<RevisionStep> parse_revision_step(std::string_view text);
/// The state after it.
RevisionState state_after(RevisionStep step);

/// Why a run was allowed.
enum class RunAllowance : std::uint8_t {
  Open,      ///< the policy asks for nothing
  Released,  ///< its revision was released
  ProveOut,  ///< a draft, on a machine for proving out
};
std::string_view to_string(RunAllowance allowance);
/// Errors: Syntax.
Result<RunAllowance> parse_run_allowance(std::string_view text);

}  // namespace dripline::storage
