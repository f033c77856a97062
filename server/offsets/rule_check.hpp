#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/offsets/offset_rule.hpp"
#include "server/offsets/setup_value.hpp"
#include "storage/offset_store.hpp"

namespace dripline::offsets {

bool is_of_rule(const storage::OffsetProposal& proposal, const OffsetRule& rule);

/// Whether the rule that made the proposal is still there, and would allow it. Errors: Conflict.
Result<void> check_allowed(const storage::OffsetProposal& proposal,
                           const std::vector<OffsetRule>& rules);

struct SetupText {
  const std::string& machine;
  std::uint64_t number = 0;  ///< 0: there is none
  const std::string& text;
};
/// What a correction would have to add to the setup, in words; empty: its tool, offset or variable
/// is there. A slip of the pen must not make a tool. Errors: Syntax.
Result<std::string> what_is_absent(const SetupText& setup, const SetupTarget& target);

}  // namespace dripline::offsets
