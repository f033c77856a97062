#include "storage/offset_store.hpp"

#include <algorithm>
#include <array>

namespace dripline::storage {
namespace {

constexpr std::array<std::string_view, 4> kOffsetStates{"pending", "applied", "rejected",
                                                        "superseded"};

}  // namespace

std::string_view to_string(OffsetState state) {
  return kOffsetStates.at(static_cast<std::size_t>(state));
}

Result<OffsetState> parse_offset_state(std::string_view text) {
  const auto* found = std::ranges::find(kOffsetStates, text);
  if (found != kOffsetStates.end()) return static_cast<OffsetState>(found - kOffsetStates.begin());
  return fail(Errc::Syntax, "state '{}': pending, applied, rejected or superseded", text);
}

Result<void> check_pending(const OffsetProposal& proposal) {
  if (proposal.state == OffsetState::Pending) return {};
  return fail(Errc::Conflict, "offset proposal {} is {} already", proposal.id,
              to_string(proposal.state));
}

}  // namespace dripline::storage
