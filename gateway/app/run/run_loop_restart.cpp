#include "gateway/app/run/run_loop.hpp"

#include <thread>
#include <utility>

#include "protocol/process/log.hpp"

/// The checkpoints of runs, and their restarts.
namespace dripline::gateway {

using machine::MachineState;

namespace {

interpreter::Position position_at(const machine::GivenAction::Point& point) {
  interpreter::Position position;
  for (const interpreter::Axis axis : interpreter::kAllAxes)
    position.set_raw(axis, point[static_cast<std::size_t>(axis)]);
  return position;
}

}  // namespace

Conditions RunLoop::conditions_of(const StartOrigin& origin) const {
  Conditions conditions;
  conditions.machine = parts_.options.machine;
  if (!origin.setup.empty()) conditions.server_setup = sha256(origin.setup).hex();
  conditions.gateway_setup = parts_.setup_digest;
  conditions.block_skip = parts_.machine.panel().block_skip;
  conditions.begun_at = parts_.machine.status().axes();
  if (!origin.from.place.empty() || origin.from.part) conditions.start = origin.argument;
  return conditions;
}

/// Nothing: the start is no restart.
Result<std::optional<RestartPlan>> RunLoop::plan_of(const report::ActiveRun& run,
                                                    const StartOrigin& origin) const {
  if (!origin.from.restart) return std::optional<RestartPlan>();
  // A later run has moved the axes, and its device may have lost the position before.
  const bool is_last = last_run_ == origin.from.restart->run;
  const auto rests_at = is_last || last_run_.empty() ? parts_.machine.rests_at() : std::nullopt;
  const bool is_kept = is_last && rests_at;
  auto plan = plan_restart(
      parts_.outbox.database(), *origin.from.restart,
      {.revision = run.revision,
       .control = run.control,
       .size = run.size,
       .conditions = conditions_of(origin),
       .rests_at = rests_at,
       .trust = is_kept ? machine::PositionTrust::Kept : parts_.machine.position_trust(),
       .memory = parts_.memory.digest()});
  if (!plan) return fail(plan.error().code, "restart: {}", plan.error().what);
  return std::optional(*std::move(plan));
}

/// At a stop the state goes to disk at once.
void RunLoop::checkpoint_at_stop(SteadyTime now) {
  const MachineState state = parts_.machine.state();
  if (std::exchange(last_state_, state) == state || !parts_.run.is_active()) return;
  const bool is_stop = state == MachineState::Held || state == MachineState::ProgramStop ||
                       state == MachineState::OptionalStop || state == MachineState::SingleBlock;
  if (!is_stop) return;
  parts_.run.session->want_checkpoint();
  next_sync_ = now;
}

/// A piece of the look-through, or its end.
void RunLoop::rebuild(SteadyTime now) {
  RunSession& session = *parts_.run.session;
  auto state = Rebuild::State::Working;
  while (state == Rebuild::State::Working && parts_.clock.steady_now() < now + kSlice) {
    session.feed().poll(now);
    state = session.rebuild();
    if (parts_.clock.steady_now() == now && ++look_rounds_ % 64 == 0) break;
  }
  if (state == Rebuild::State::Ready) show_restart();
  if (state == Rebuild::State::Failed)
    end(dds::RunOutcome::Aborted, fmt::format("restart: {}", session.restart()->fault()));
}

std::string RunLoop::overdue_reason() const {
  const auto seconds = parts_.options.cycle_start_wait.count();
  if (!is_rebuilding()) return fmt::format("no cycle start at the machine within {} s", seconds);
  return fmt::format("restart: the program was not looked through within {} s, but to block {}{}",
                     seconds, parts_.run.session->restart()->block(),
                     is_looking_through() ? "" : ": its text did not come");
}

/// Nothing is executed that waits for this. A cut is worth more than a checkpoint: without room for
/// one the machine moves on, and a restart begins at the one before.
void RunLoop::commit_state() {
  const auto done = parts_.recorder.commit();
  if (done) return;
  if (!std::exchange(has_dropped_checkpoint_, true)) {
    process::log_warning("checkpoints cannot be kept: {} {}", done.error().what,
                         parts_.run.label());
  }
  parts_.outbox.checkpoints().drop_checkpoints();
  (void)parts_.recorder.commit();
}

/// The operator sees it before cycle start, and has all the time for it.
void RunLoop::show_restart() {
  parts_.consent.await_confirmation(parts_.clock.steady_now() + parts_.options.cycle_start_wait);
  RunSession& session = *parts_.run.session;
  const RestartReport& report = session.restart()->report();
  process::log_info("restart of run {} after block {}: state {}, path {} {}", report.original.run,
                    report.after.block, report.state_equal_at ? "equal" : "without a record",
                    report.is_path_equal ? "equal" : "without a record", parts_.run.label());
  parts_.recorder.continue_after(report.after);
  parts_.recorder.note_restart(to_json(report));
  session.size_feed(parts_.options.speed.factor);
}

InHand RunLoop::in_hand(const std::string& run, std::uint64_t executed) const {
  if (parts_.motion_journal == nullptr) return {};
  return motion_of(parts_.motion_journal->read(run, executed));
}

/// A device continues with what it has when its gateway is killed, and stops soon.
void RunLoop::resolve_interrupted(const std::string& run, RunEnding& ending) {
  ending.in_hand = in_hand(run, ending.executed.executed);
  if (ending.in_hand.empty()) return;
  const SteadyTime limit = parts_.clock.steady_now() + kRestWait;
  auto at = parts_.machine.rests_at();
  for (; !at && parts_.clock.steady_now() < limit; at = parts_.machine.rests_at()) {
    parts_.serve_panel();
    (void)parts_.machine.poll(machine::Seconds{0}, 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  // Not of the status: before a board is identified that has no axes.
  if (at) ending.stopped_at = position_at(*at);
  ending.rested_at = at;
  (void)resolve(ending.in_hand, at, ending.executed);
}

/// A device that was stopped by an alarm shows only later how far it has come.
void RunLoop::resolve_at_rest() {
  if (!resting_ || parts_.run.session) return;
  if (!resting_->ending.rested_at) {
    const auto at = parts_.machine.rests_at();
    if (!at) return;
    resting_->ending.rested_at = at;
    resting_->ending.stopped_at = position_at(*at);
  }
  const SteadyTime now = parts_.clock.steady_now();
  if (now < resting_->next_commit) return;
  parts_.outbox.checkpoints().stage_ending(resting_->run, encode(resting_->run, resting_->ending));
  if (parts_.outbox.commit())
    resting_.reset();
  else
    resting_->next_commit = now + kCommitRetry;
}

/// Before the record of the run's end, and in the same transaction.
void RunLoop::stage_ending(dds::RunOutcome outcome) {
  if (!parts_.run.session->keeps_checkpoints()) return;
  const bool is_completed = outcome == dds::RunOutcome::Completed;
  RunSession& session = *parts_.run.session;
  if (!is_completed) session.want_checkpoint();
  RunEnding ending;
  ending.executed = parts_.recorder.reached();
  ending.time_us = parts_.clock.now().time_since_epoch().count();
  ending.is_completed = is_completed;
  const machine::MachineStatus status = parts_.machine.status();
  ending.stopped_at = status.axes();
  const bool cuts_thread = status.motion == machine::MotionKind::Thread || status.is_tapping;
  ending.is_in_thread =
      !is_completed && cuts_thread && status.origin.block > ending.executed.executed;
  ending.memory = parts_.memory.digest();
  const std::string& run = session.run().run;
  if (!is_completed) ending.in_hand = in_hand(run, ending.executed.executed);
  // A machine that was stopped shows where it rests, and the operator may move it away.
  if (outcome == dds::RunOutcome::Aborted || outcome == dds::RunOutcome::Interrupted) {
    ending.rested_at = parts_.machine.rests_at();
    (void)resolve(ending.in_hand, ending.rested_at, ending.executed);
  }
  if (!ending.in_hand.empty() && !ending.rested_at) resting_ = Resting{run, ending, {}};
  parts_.outbox.checkpoints().stage_ending(run, encode(run, std::move(ending)));
}

}  // namespace dripline::gateway
