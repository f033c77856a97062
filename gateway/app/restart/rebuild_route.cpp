// Where the tool has been before the place, and what the program does after it.
#include <algorithm>

#include "gateway/app/restart/rebuild.hpp"

namespace dripline::gateway {
namespace {

/// Blocks before the place: of a lathe's path, and of a thread that the place may be in.
constexpr std::uint64_t kRouteBlocks = PassedPath::kMaxMoves;
constexpr std::uint64_t kThreadBlocks = 64;
/// Blocks after the one that the run was in, until compensation has given what that one moves.
constexpr std::size_t kRouteSteps = 64;

}  // namespace

/// From some blocks before the place on, up to the block that the run was in.
Rebuild::State Rebuild::begin_route() {
  // Nothing was executed: no thread is continued, and what is checked at a start is still to come.
  if (target_ == 0 && !parts_.is_lathe) return begin_proof();
  const auto& checkpoints = parts_.plan.checkpoints;
  const std::uint64_t back = parts_.is_lathe ? kRouteBlocks : kThreadBlocks;
  const std::size_t place = parts_.plan.nearest(target_ > back ? target_ - back : 0);
  if (!load(checkpoints[place].block)) return State::Failed;
  const std::uint64_t executed = parts_.plan.ending.executed.executed;
  const Conditions& conditions = parts_.plan.conditions;
  PassedPath::Begin begin;
  begin.target = target_;
  begin.executed = parts_.is_lathe ? std::max(executed, target_) : target_;
  begin.shifts_with_tool = parts_.machine.capabilities().adds_lengths;
  begin.is_begin_of_run = checkpoints[place].block == 0 && conditions.start.empty() &&
                          conditions.restart_of.empty() && !begin.shifts_with_tool;
  if (begin.is_begin_of_run) {
    begin.at = conditions.begun_at;
    for (const interpreter::Axis axis : interpreter::kAllAxes) begin.at.mark(axis);
  } else {
    begin.at = parts_.tracker.delivered().position;
  }
  passed_.begin(begin);
  parts_.tracker.show(passed_);
  goal_ = begin.executed + 1;
  route_steps_ = 0;
  phase_ = Phase::Route;
  return State::Working;
}

Rebuild::State Rebuild::route() {
  const std::uint64_t now = parts_.interpreter.blocks();
  const bool is_known = passed_.has_ended(goal_) && passed_.has_continued();
  if (is_known || route_steps_ > kRouteSteps) return begin_proof();
  if (now >= goal_) ++route_steps_;
  const Step step = run_to(now < goal_ ? goal_ : now + 1, true);
  if (step == Step::Failed) return State::Failed;
  if (step == Step::NeedsText) return State::NeedsText;
  return step == Step::Ended ? begin_proof() : State::Working;
}

}  // namespace dripline::gateway
