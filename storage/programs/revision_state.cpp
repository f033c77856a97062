#include "storage/programs/revision_state.hpp"

#include <fmt/ranges.h>
#include <algorithm>
#include <array>

namespace dripline::storage {
namespace {

constexpr std::array<std::string_view, 5> kStates{"draft", "in_review", "approved", "released",
                                                  "withdrawn"};
constexpr std::array<std::string_view, kRevisionSteps> kSteps{"submit", "approve", "reject",
                                                              "release", "withdraw"};
constexpr std::array<std::string_view, 3> kAllowances{"open", "released", "prove_out"};

template <class Enum, class Words>
Result<Enum> parse_in(const Words& words, std::string_view text, std::string_view what) {
  const auto found = std::ranges::find(words, text);
  if (found != words.end()) return static_cast<Enum>(found - words.begin());
  return fail(Errc::Syntax, "'{}' is no {}: {}", text, what, fmt::join(words, ", "));
}

}  // namespace

std::string_view to_string(RevisionState state) {
  return kStates.at(static_cast<std::size_t>(state));
}
Result<RevisionState> parse_revision_state(std::string_view text) {
  return parse_in<RevisionState>(kStates, text, "state of a revision");
}

std::string_view to_string(RevisionStep step) {
  return kSteps.at(static_cast<std::size_t>(step));
}
Result<RevisionStep> parse_revision_step(std::string_view text) {
  return parse_in<RevisionStep>(kSteps, text, "step of a revision");
}

RevisionState state_after(RevisionStep step) {
  using enum RevisionState;
  constexpr std::array<RevisionState, kRevisionSteps> kAfter{InReview, Approved, Draft, Released,
                                                             Withdrawn};
  return kAfter.at(static_cast<std::size_t>(step));
}

std::string_view to_string(RunAllowance allowance) {
  return kAllowances.at(static_cast<std::size_t>(allowance));
}
Result<RunAllowance> parse_run_allowance(std::string_view text) {
  return parse_in<RunAllowance>(kAllowances, text, "reason for a run");
}

}  // namespace dripline::storage
