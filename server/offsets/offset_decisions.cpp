// What a person, or a rule's policy, decides about a proposal.
#include <algorithm>

#include "protocol/process/log.hpp"
#include "server/offsets/memory_check.hpp"
#include "server/offsets/offsets_current.hpp"
#include "server/offsets/value_in_force.hpp"

namespace dripline::offsets {
namespace {

using storage::OffsetProposal;

/// Why the setup has this value, in its comment; the whole reasons are in the proposal.
std::string comment_of(const OffsetProposal& proposal, const storage::OffsetDecision& decision) {
  return fmt::format("offset proposal {}, rule {}: {} {} to {} {}{}{}", proposal.id, proposal.rule,
                     proposal.target, proposal.old_value, proposal.new_value, proposal.unit,
                     decision.comment.empty() ? "" : ": ", decision.comment);
}

}  // namespace

Result<OffsetRule> Offsets::rule_of(const OffsetProposal& proposal) {
  const auto stored = parts_.store.offsets.rules(proposal.machine);
  if (!stored && stored.error().code != Errc::NotFound) return fail(stored.error());
  const auto rules = stored ? parse_offset_rules(stored->text) : Result<std::vector<OffsetRule>>{};
  if (!rules) return fail(rules.error());
  if (auto allowed = check_allowed(proposal, *rules); !allowed) return fail(allowed.error());
  return *std::ranges::find_if(*rules,
                               [&](const OffsetRule& rule) { return is_of_rule(proposal, rule); });
}

/// What it was made from may have been derived again since, or not be all any more.
Result<void> Offsets::check_measured(const Current& now, const OffsetRule& rule,
                                     const OffsetProposal& proposal) {
  if (proposal.used == 0) return {};  // it names none that could have changed
  const auto again = measured(now, rule);
  if (!again) return fail(again.error());
  const Outcome& outcome = again->outcome;
  if (outcome.new_value && is_same_number(*outcome.new_value, proposal.new_value) &&
      is_same_number(again->value, proposal.old_value) && outcome.first == proposal.first &&
      outcome.last == proposal.last && outcome.used == proposal.used) {
    return {};
  }
  const std::string why =
      fmt::format("its measurements are not the current ones any more; by now: {}",
                  fmt::join(outcome.reasons, "; "));
  if (auto done =
          parts_.store.offsets.withdraw(proposal.machine, proposal.target, parts_.clock.now(), why);
      !done)
    return done;
  note(proposal.machine);
  return fail(Errc::Conflict, "offset proposal {} is superseded: {}", proposal.id, why);
}

Result<OffsetProposal> Offsets::approve(const storage::OffsetDecision& given) {
  if (given.comment.size() > kMaxComment)
    return fail(Errc::LimitExceeded, "a comment of {} bytes, at most {}", given.comment.size(),
                kMaxComment);
  storage::OffsetDecision decision = given;
  decision.time = parts_.clock.now();
  const auto proposal = parts_.store.offsets.find(decision.id);
  if (!proposal) return fail(proposal.error());
  if (auto pending = storage::check_pending(*proposal); !pending) return fail(pending.error());
  const auto rule = rule_of(*proposal);
  if (!rule) return fail(rule.error());
  const auto now = current_of(proposal->machine);
  if (!now) return fail(now.error());
  if (now->setup != proposal->base) {
    return fail(Errc::Conflict,
                "offset proposal {} was made from setup {} of {}, and {} is the newest by now",
                proposal->id, proposal->base, proposal->machine, now->setup);
  }
  const auto target = parse_setup_target(proposal->target);
  if (!target) return fail(target.error());
  if (const auto lack = what_control_lacks(now->control, *target); !lack.empty())
    return fail(Errc::Conflict, "offset proposal {}: {}", proposal->id, lack);
  const auto absent = what_is_absent(now->place(), *target);
  if (!absent) return fail(absent.error());
  if (!absent->empty())
    return fail(Errc::Conflict, "offset proposal {}: {}", proposal->id, *absent);
  if (auto current = check_measured(*now, *rule, *proposal); !current) return fail(current.error());
  auto text = with_value(now->text, *target, proposal->new_value, kDecimals);
  if (!text) return fail(text.error());
  const auto form = what_form_lacks(*now, *text);
  if (!form) return fail(form.error());
  if (!form->empty()) return fail(Errc::Conflict, "offset proposal {}: {}", proposal->id, *form);
  const auto doubt = doubt_at_approval(
      parts_.store, {now->machine, now->control, proposal->target, now->text, *text});
  if (!doubt) return fail(doubt.error());
  if (!doubt->empty())
    return fail(Errc::Conflict, "offset proposal {} of {}: {}", proposal->id, proposal->machine,
                *doubt);
  auto saved = parts_.setups.save_by({.machine = now->machine,
                                      .control = now->control,
                                      .text = *std::move(text),
                                      .comment = comment_of(*proposal, decision),
                                      .base = proposal->base},
                                     decision.who, [&](const storage::SetupRevision& setup) {
                                       return parts_.store.offsets.apply(decision, setup);
                                     });
  if (!saved) return fail(saved.error());
  process::log_info("offset proposal {} machine={} applied as setup {} by={}", proposal->id,
                    proposal->machine, saved->number, decision.who.name);
  auto decided = parts_.store.offsets.find(decision.id);
  if (decided) publish(*decided);
  return decided;
}

Result<OffsetProposal> Offsets::reject(storage::OffsetDecision decision) {
  if (decision.comment.size() > kMaxComment)
    return fail(Errc::LimitExceeded, "a comment of {} bytes, at most {}", decision.comment.size(),
                kMaxComment);
  if (decision.comment.find_first_not_of(" \t\r\n") == std::string::npos)
    return fail(Errc::Syntax, "a rejection needs a reason");
  decision.time = parts_.clock.now();
  auto rejected = parts_.store.offsets.reject(decision);
  if (rejected) publish(*rejected);
  return rejected;
}

}  // namespace dripline::offsets
