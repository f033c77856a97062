#include "gateway/app/restart/restart_plan.hpp"

#include <algorithm>
#include <cmath>

namespace dripline::gateway {

using report::CheckpointStore;

namespace {

using Kind = RestartPlace::Kind;

std::string switch_text(bool is_on) {
  return is_on ? "on" : "off";
}

std::string skip_text_of(const Conditions& then) {
  return fmt::format(
      "within the run {}, and a restart looks through the program with one setting: set it as it "
      "was at the start and restart at a place before the change, or start the program at a block "
      "(--from)",
      then.skip_changes);
}

/// What has changed since the run, in one text; empty: nothing.
std::string changes(const report::ActiveRun& original, const Conditions& then,
                    const RunEnding& ending, const PresentState& now) {
  std::string text;
  const auto add = [&text](std::string_view what) {
    if (!text.empty()) text += "; ";
    text += what;
  };
  if (then.machine != now.conditions.machine)
    add(fmt::format("the machine was {}, it is {}", then.machine, now.conditions.machine));
  if (original.control != now.control)
    add(fmt::format("the control was {}, it is {}", original.control, now.control));
  if (original.revision != now.revision || original.size != now.size) {
    add(fmt::format("the program's content was {}, it is {}", original.revision.substr(0, 12),
                    now.revision.substr(0, 12)));
  }
  if (then.server_setup != now.conditions.server_setup) add("the machine's setup on the server");
  if (then.gateway_setup != now.conditions.gateway_setup) add("the gateway's setup file");
  if (then.block_skip != now.conditions.block_skip) {
    add(fmt::format("the switch block_skip was {}{}, it is {}", switch_text(then.block_skip),
                    then.skip_changes.empty() ? "" : " at its start",
                    switch_text(now.conditions.block_skip)));
    if (!then.skip_changes.empty()) add(skip_text_of(then));
  }
  if (ending.memory != now.memory) add("the control's memory (variables, offsets)");
  return text;
}

std::string axes_text(const machine::GivenAction::Point& at, const InHand& in_hand) {
  std::string text;
  for (const interpreter::Axis axis : interpreter::kAllAxes) {
    const auto i = static_cast<std::size_t>(axis);
    const bool moves = std::ranges::any_of(in_hand, [i](const auto& entry) {
      return entry.action.kind == machine::GivenAction::Kind::Motion &&
             entry.action.from[i] != entry.action.end[i];
    });
    if (at[i] != 0 || moves) text += fmt::format(" {} {:.3f}", interpreter::letter(axis), at[i]);
  }
  return text;
}

/// Nothing is cut twice, or left out, without being asked: where the axes do not tell, the operator
/// names the block.
Result<void> resolve_place(RestartPlan& plan,
                           const std::optional<machine::GivenAction::Point>& rests_at) {
  plan.on_record = plan.ending.executed.executed;
  if (plan.at.kind != Kind::Executed) return {};
  const auto& at = plan.ending.rested_at ? plan.ending.rested_at : rests_at;
  if (resolve(plan.ending.in_hand, at, plan.ending.executed)) return {};
  const std::uint64_t executed = plan.ending.executed.executed;
  const std::uint64_t last = last_block(plan.ending.in_hand);
  return fail(
      Errc::Conflict,
      "run {} has executed block {} on record, but its machine may have done up to {} "
      "blocks more; the axes {}{}, which does not show how many: look at the part and "
      "name the block that continues, block={} to block={}",
      plan.original.run, executed, last - executed, plan.ending.rested_at ? "rested then" : "are",
      at ? axes_text(*at, plan.ending.in_hand) : " at a place not known", executed + 1, last + 1);
}

/// What a board shows after it was switched on.
constexpr std::string_view kAtZero = " 0";

/// Of the axes that are not at 0.
std::string position_text(const interpreter::Position& at) {
  std::string text;
  for (const interpreter::Axis axis : interpreter::kAllAxes)
    if (at.raw(axis) != 0)
      text += fmt::format(" {}{:.3f}", interpreter::letter(axis), at.raw(axis));
  return text.empty() ? std::string(kAtZero) : text;
}

std::string_view words_of(machine::PositionTrust trust) {
  switch (trust) {
    case machine::PositionTrust::Reconnected:
      return "the machine was connected since, and may have been switched off";
    case machine::PositionTrust::Unlocked:
      return "the machine has lost its position since and was unlocked without homing";
    default:
      return "the machine has lost its position since";
  }
}

/// After the end of what was executed the path continues from machine coordinates: they are those
/// of the run, or it is refused.
Result<void> check_trust(RestartPlan& plan, const PresentState& present) {
  using machine::PositionTrust;
  const std::uint64_t executed = plan.ending.executed.executed;
  if (plan.at.kind == Kind::Block || plan.known_target() != executed) return {};
  if (present.trust == PositionTrust::Kept || present.trust == PositionTrust::Homed) return {};
  const auto& stopped = plan.ending.stopped_at;
  const auto& now = present.conditions.begun_at;
  const auto differs = [&](interpreter::Axis axis) {
    return std::fabs(stopped->raw(axis) - now.raw(axis)) > kSameAxes;
  };
  // The count of a board that was only stopped while it moved is the same, and says nothing.
  const bool may_be_kept = present.trust == PositionTrust::Reconnected && stopped;
  if (may_be_kept && std::ranges::none_of(interpreter::kAllAxes, differs)) return {};
  // After a kill with nothing in hand the machine had done all that it got, and rested there.
  const bool rests_at_end = present.trust == PositionTrust::Reconnected && !stopped;
  std::string axes;
  if (may_be_kept) {
    axes = fmt::format(", and its axes are at{}, where that run stopped at{}", position_text(now),
                       position_text(*stopped));
  } else if (rests_at_end) {
    axes = fmt::format(", and its axes at{} do not show that it was not", position_text(now));
  }
  std::string text = fmt::format(
      "run {}: {}{}: home the machine, or look at the part and name the block that continues, "
      "block={}",
      plan.original.run, words_of(present.trust), axes, executed + 1);
  if (!rests_at_end || position_text(now) == kAtZero) return fail(Errc::Conflict, "{}", text);
  plan.doubt = std::move(text);
  return {};
}

Result<void> check_place(const RestartPlan& plan) {
  const auto target = plan.known_target();
  const std::uint64_t executed =
      std::max(plan.ending.executed.executed, last_block(plan.ending.in_hand));
  if (plan.at.kind == Kind::Block && plan.at.number == 0)
    return fail(Errc::LimitExceeded, "block=0: blocks are counted from 1");
  if (target && *target > executed) {
    return fail(Errc::LimitExceeded,
                "{}: run {} has executed {} blocks; it continues at {} at most", plan.at.text,
                plan.original.run, executed, executed + 1);
  }
  if (plan.at.kind == Kind::Time && plan.checkpoints.front().time > plan.at.time) {
    return fail(Errc::LimitExceeded, "{}: run {} began at {}", plan.at.text, plan.original.run,
                to_iso8601(plan.checkpoints.front().time));
  }
  return {};
}

}  // namespace

std::optional<std::uint64_t> RestartPlan::known_target() const {
  if (at.kind == Kind::Executed) return ending.executed.executed;
  if (at.kind == Kind::Block) return at.number - 1;
  if (at.kind != Kind::Time) return std::nullopt;
  if (UtcTime(std::chrono::microseconds(ending.time_us)) <= at.time)
    return ending.executed.executed;
  std::uint64_t executed = 0;
  for (const report::StoredCheckpoint& one : checkpoints) {
    if (one.time <= at.time) executed = std::max(executed, one.executed);
  }
  return executed;
}

std::string RestartPlan::skip_text() const {
  return conditions.skip_changes.empty() ? std::string() : skip_text_of(conditions);
}

std::size_t RestartPlan::nearest(std::uint64_t block) const {
  const auto after =
      std::upper_bound(checkpoints.begin(), checkpoints.end(), block,
                       [](std::uint64_t wanted, const auto& one) { return wanted < one.block; });
  return after == checkpoints.begin() ? 0
                                      : static_cast<std::size_t>(after - checkpoints.begin()) - 1;
}

Result<Checkpoint> read_checkpoint(storage::sqlite::Database& database, const std::string& run,
                                   std::uint64_t block) {
  const auto stored = CheckpointStore::read(database, run, block);
  if (!stored) return fail(stored.error());
  auto checkpoint = decode_checkpoint(run, stored->bytes);
  if (checkpoint && checkpoint->block == block) return checkpoint;
  return fail(Errc::Corrupt, "the checkpoint of run {} at block {}: {}", run, block,
              checkpoint ? "it is another block's" : checkpoint.error().what);
}

Result<RestartPlan> plan_restart(storage::sqlite::Database& database,
                                 const RestartArgument& argument, const PresentState& present) {
  const auto stored = CheckpointStore::find(database, argument.run);
  if (!stored) {
    if (stored.error().code != Errc::NotFound) return fail(stored.error());
    return fail(Errc::NotFound, "{}: this machine keeps those of its last {} runs",
                stored.error().what, CheckpointStore::kKeptRuns);
  }
  if (stored->ending.empty()) return fail(Errc::Conflict, "run {} has not ended", argument.run);
  RestartPlan plan;
  plan.original = stored->run;
  plan.at = argument.at;
  auto conditions = decode_conditions(argument.run, stored->conditions);
  if (!conditions) return fail(conditions.error());
  plan.conditions = *std::move(conditions);
  auto ending = decode_ending(argument.run, stored->ending);
  if (!ending) return fail(ending.error());
  plan.ending = *std::move(ending);
  if (plan.ending.is_completed) {
    return fail(Errc::Conflict, "run {} was completed: there is nothing left to continue",
                argument.run);
  }
  if (auto resolved = resolve_place(plan, present.rests_at); !resolved)
    return fail(resolved.error());
  if (auto trusted = check_trust(plan, present); !trusted) return fail(trusted.error());
  const std::string changed = changes(plan.original, plan.conditions, plan.ending, present);
  if (!changed.empty())
    return fail(Errc::Conflict, "changed since run {}: {}", argument.run, changed);
  auto checkpoints = CheckpointStore::list(database, argument.run);
  if (!checkpoints) return fail(checkpoints.error());
  plan.checkpoints = *std::move(checkpoints);
  if (plan.checkpoints.empty()) {
    const std::string& original = plan.conditions.restart_of;
    return fail(Errc::NotFound, "no checkpoints of run {} are kept{}{}", argument.run,
                original.empty() ? "" : ": it executed nothing, and it is a restart of run ",
                original);
  }
  if (auto good = check_place(plan); !good) return fail(good.error());
  return plan;
}

}  // namespace dripline::gateway
