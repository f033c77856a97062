#include "server/offsets/rule_check.hpp"

#include <algorithm>
#include <cmath>

#include "server/offsets/proposal.hpp"

namespace dripline::offsets {

bool is_of_rule(const storage::OffsetProposal& proposal, const OffsetRule& rule) {
  return rule.name == proposal.rule && rule.target == proposal.target;
}

Result<void> check_allowed(const storage::OffsetProposal& proposal,
                           const std::vector<OffsetRule>& rules) {
  const auto rule =
      std::ranges::find_if(rules, [&](const OffsetRule& one) { return is_of_rule(proposal, one); });
  if (rule == rules.end()) {
    return fail(Errc::Conflict,
                "offset proposal {} was made by rule {} for {}, which is not among the rules of {} "
                "any more",
                proposal.id, proposal.rule, proposal.target, proposal.machine);
  }
  if (!is_at_most(std::abs(proposal.new_value - proposal.old_value), rule->max_step)) {
    return fail(Errc::Conflict,
                "offset proposal {}: {} to {} is beyond the largest step of rule {} by now, {}",
                proposal.id, proposal.old_value, proposal.new_value, rule->name, rule->max_step);
  }
  if ((rule->lowest && proposal.new_value < *rule->lowest) ||
      (rule->highest && proposal.new_value > *rule->highest)) {
    return fail(Errc::Conflict, "offset proposal {}: {} is outside of the bounds of rule {} by now",
                proposal.id, proposal.new_value, rule->name);
  }
  return {};
}

Result<std::string> what_is_absent(const SetupText& setup, const SetupTarget& target) {
  if (setup.number == 0) {
    return fmt::format("machine {} has no setup on the server, so there is no {}", setup.machine,
                       owner_of(target));
  }
  const auto is_there = is_in_setup(setup.text, target);
  if (!is_there) return fail(is_there.error());
  if (*is_there) return std::string();
  return fmt::format("setup {} of {} has no {}", setup.number, setup.machine, owner_of(target));
}

}  // namespace dripline::offsets
