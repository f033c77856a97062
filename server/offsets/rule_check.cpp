#include "server/offsets/rule_check.hpp"

#include <algorithm>
#include <cmath>

#include "gateway/interpreter/setup_values.hpp"
#include "server/offsets/value_in_force.hpp"

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

Result<void> check_corrected_once(const std::vector<OffsetRule>& rules, std::string_view control) {
  for (auto one = rules.begin(); one != rules.end(); ++one) {
    for (auto other = rules.begin(); other != one; ++other) {
      if (one->characteristic != other->characteristic) continue;
      const auto target = parse_setup_target(one->target);
      if (!target) return fail(target.error());
      const auto before = parse_setup_target(other->target);
      if (!before) return fail(before.error());
      if (!moves_the_same(*target, *before, control)) continue;
      return fail(Errc::Conflict,
                  "rule {}: {} moves what {} of rule {} moves, and both would correct {}: one "
                  "deviation would be corrected twice",
                  one->name, one->target, other->target, other->name, one->characteristic);
    }
  }
  return {};
}

Result<Rejection> rejection_of(storage::OffsetStore& store, const NextStep& step) {
  const OffsetRule& rule = step.rule;
  storage::OffsetFilter filter{
      .machine = step.machine, .target = rule.target, .state = storage::OffsetState::Rejected};
  const auto rejected = store.list(filter, {.limit = 1});
  if (!rejected) return fail(rejected.error());
  if (rejected->empty()) return Rejection{};
  const storage::OffsetProposal& last = rejected->front();
  const bool is_same = is_of_rule(last, rule) &&
                       is_at_most(std::abs(last.old_value - step.value), 0) &&
                       is_at_most(std::abs(last.new_value - step.new_value), 0);
  const auto is_newer = [&](const Deviation& one) { return one.measurement > last.last; };
  const auto newer = static_cast<std::size_t>(std::ranges::count_if(step.measured, is_newer));
  if (!is_same) return Rejection{};
  if (newer >= rule.min_count) return Rejection{.is_same_step = true};
  return Rejection{.is_same_step = true,
                   .doubt = fmt::format("{} rejected it as offset proposal {}: {}. It comes again "
                                        "with another value, or after {} "
                                        "measurements more; there are {}",
                                        last.who, last.id, last.comment, rule.min_count, newer)};
}

std::string what_control_lacks(std::string_view control, const SetupTarget& target) {
  using Kind = SetupTarget::Kind;
  const auto values = interpreter::setup_values(control);
  switch (target.kind) {
    case Kind::Variable:
      return values.has_variables ? "" : fmt::format("{} has no variables in its setup", control);
    case Kind::Offset:
      return values.has_offsets ? "" : fmt::format("{} has no offsets in its setup", control);
    default:
      break;
  }
  const std::string key = (target.kind == Kind::Wear ? "wear." : "") + target.key;
  if (std::ranges::find(values.tool, key) != values.tool.end()) return {};
  if (values.tool.empty()) return fmt::format("{} has no tools in its setup", control);
  return fmt::format("{} has no {} of a tool, so a correction of it would do nothing; it has {}",
                     control, key, fmt::join(values.tool, ", "));
}

std::string words_of_x(const OffsetRule& rule, const std::string& kind) {
  const bool is_radius = kind == "radius";
  return fmt::format(
      "{} is a {} in the setup: the scale is {} for a characteristic that is a diameter and {} for "
      "one that is a radius, below 0 where they go against each other; this rule's is {:g}",
      rule.target, kind, is_radius ? "0.5" : "1", is_radius ? "1" : "2", rule.scale);
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
