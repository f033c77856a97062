#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "server/offsets/offset_rule.hpp"
#include "server/offsets/proposal.hpp"
#include "server/offsets/setup_value.hpp"
#include "storage/offset_store.hpp"

namespace dripline::offsets {

bool is_of_rule(const storage::OffsetProposal& proposal, const OffsetRule& rule);

/// Whether the rule that made the proposal is still there, and would allow it. Errors: Conflict.
Result<void> check_allowed(const storage::OffsetProposal& proposal,
                           const std::vector<OffsetRule>& rules);

/// No two rules correct one deviation twice: by one characteristic, values that move the same.
/// Errors: Conflict.
Result<void> check_corrected_once(const std::vector<OffsetRule>& rules, std::string_view control);

struct NextStep {
  const std::string& machine;
  const OffsetRule& rule;
  double value = 0, new_value = 0;
  const std::vector<Deviation>& measured;
};
struct Rejection {
  bool is_same_step = false;  ///< a person has rejected it: it is not applied without one
  std::string doubt = {};     ///< why it is not proposed again; empty: it may be
};
/// Whether a person has rejected the same step. It is proposed again when min_count more
/// measurements ask for it. Errors: those of the store.
Result<Rejection> rejection_of(storage::OffsetStore& store, const NextStep& step);

struct SetupText {
  const std::string& machine;
  std::uint64_t number = 0;  ///< 0: there is none
  const std::string& text;
};
/// Why a correction of the target would have no effect at the machine, whatever its setup says;
/// empty: the control has such a value.
std::string what_control_lacks(std::string_view control, const SetupTarget& target);

/// Half of a step, or twice, is what a wrong scale makes: the person who approves it should see it.
std::string words_of_x(const OffsetRule& rule, const std::string& kind);

/// What a correction would have to add to the setup, in words; empty: its tool, offset or variable
/// is there. A slip of the pen must not make a tool. Errors: Syntax.
Result<std::string> what_is_absent(const SetupText& setup, const SetupTarget& target);

}  // namespace dripline::offsets
