#include "gateway/app/run/run_loop.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include "protocol/process/log.hpp"

namespace dripline::gateway {

using machine::MachineState;
using std::chrono::milliseconds;

namespace {

constexpr std::size_t kBlocksPerRound = 256;
constexpr std::size_t kActionsPerRound = 512;
constexpr int kMaxRounds = 4096;  ///< bounds a slice even if the clock does not advance
constexpr milliseconds kSyncInterval{1000};
constexpr std::uint64_t kCheckpointBlocks = 1'000'000;  ///< between two checkpoints at most

std::string uncertain_text(const RunEnding& ending) {
  if (ending.in_hand.empty()) return {};
  return fmt::format(" (the machine may have gone on to block {})", last_block(ending.in_hand));
}

}  // namespace

void RunLoop::step(SteadyTime now) {
  if (!parts_.run.session) return resolve_at_rest();
  parts_.run.session->feed().poll(now);
  parts_.run.is_ending ? try_to_finish(now) : run_slice(now);
}

void RunLoop::run_slice(SteadyTime now) {
  const auto elapsed = std::clamp<SteadyTime::duration>(now - last_step_, {}, kLongestStep);
  last_step_ = now;
  const auto& factor = parts_.options.speed.factor;
  double seconds = factor ? std::chrono::duration<double>(elapsed).count() * *factor
                          : std::numeric_limits<double>::infinity();
  if (wait_for_beginning(now)) return;
  if (wait_out_fault(now)) {
    (void)parts_.machine.poll(machine::Seconds{seconds}, 0);  // comes to rest, begins nothing
    return;
  }
  parts_.run.session->note_real_time(elapsed);
  for (int round = 0; round < kMaxRounds; ++round) {
    if (!run_round(seconds, now + kSlice)) break;
  }
  commit_reports();
  checkpoint_at_stop(now);
  check_end();
  if (now >= next_sync_ || now >= next_checkpoint_) keep_state(now);
  if (now < next_sync_) return;
  next_sync_ = now + kSyncInterval;
  if (const auto done = parts_.journal.sync(); !done)
    process::log_warning("{} {}", done.error().what, parts_.run.label());
}

/// Some blocks in, some actions out. False: nothing more can be done in this slice.
bool RunLoop::run_round(double& machine_seconds, SteadyTime deadline) {
  if (parts_.recorder.alarm() || parts_.recorder.was_aborted()) return false;
  const std::size_t blocks = parts_.run.session->fill(kBlocksPerRound);
  const std::size_t queued = parts_.machine.status().queued;
  const double used =
      parts_.machine.poll(machine::Seconds{machine_seconds}, kActionsPerRound).count();
  machine_seconds -= used;
  parts_.run.session->pass_machine_time(used, parts_.options.speed.factor);
  const bool has_advanced = used > 0 || parts_.machine.status().queued != queued;
  const bool can_continue = (blocks > 0 || has_advanced) && machine_seconds > 0;
  return can_continue && parts_.recorder.fault().empty() && parts_.clock.steady_now() < deadline;
}

/// True: the run was not begun at the machine yet, or its program is still looked through. Nothing
/// of it reaches the machine; an abort works.
bool RunLoop::wait_for_beginning(SteadyTime now) {
  const bool is_awaited = parts_.consent.is_awaited();
  if (!is_awaited && !is_checking()) return false;
  (void)parts_.machine.poll(machine::Seconds{0}, 0);
  if (is_rebuilding()) rebuild(now);
  if (is_checking()) check_program(now);
  if (!parts_.run.is_active()) return true;
  commit_reports();
  if (is_awaited && parts_.consent.is_overdue(now)) {
    end(dds::RunOutcome::Aborted, overdue_reason());
  } else {
    check_end();
  }
  return true;
}

/// What the machine cannot do ends the run before its first move.
void RunLoop::check_program(SteadyTime now) {
  RunSession& session = *parts_.run.session;
  ProgramCheck& check = *session.check();
  if (session.is_test() && parts_.machine.panel().emergency_stop)
    return end(dds::RunOutcome::Aborted, "EMERGENCY STOP");
  auto state = ProgramCheck::State::Working;
  while (state == ProgramCheck::State::Working && parts_.clock.steady_now() < now + kSlice) {
    session.feed().poll(now);
    state = check.work(parts_.clock.steady_now());
    if (parts_.clock.steady_now() == now && ++look_rounds_ % 64 == 0) break;
  }
  if (!check.is_over()) return;
  if (session.is_test()) return end_test(check);
  if (state == ProgramCheck::State::Refused) {
    const interpreter::Alarm refusal = check.refusal();
    session.end_check();
    return parts_.recorder.on_alarm(refusal);
  }
  session.end_check();
  session.size_feed(parts_.options.speed.factor);
}

bool RunLoop::is_looking_through() const {
  if (is_rebuilding()) return parts_.run.session->restart()->state() == Rebuild::State::Working;
  return is_checking() && parts_.run.session->check()->state() == ProgramCheck::State::Working;
}

void RunLoop::cycle_start() {
  parts_.consent.end_wait();
  process::log_info("cycle start {}", parts_.run.label());
  last_step_ = parts_.clock.steady_now();
  (void)parts_.machine.resume();  // from a hold that was commanded meanwhile
}

/// What executed blocks have changed in the control's memory is written with the next reports, or
/// by itself: a kill loses the changes of the last kSyncInterval. Checkpoints likewise.
void RunLoop::keep_state(SteadyTime now) {
  if (!parts_.run.is_active()) return;
  RunSession& session = *parts_.run.session;
  if (now >= next_checkpoint_ || session.blocks_since_checkpoint() >= kCheckpointBlocks) {
    next_checkpoint_ = now + parts_.options.checkpoint_interval;
    session.want_checkpoint();
  }
  session.keep_memory(parts_.machine.status().executed);
  const bool has_memory = parts_.memory.has_unstaged();
  if (has_memory) parts_.memory.stage();
  if (!has_memory && !parts_.outbox.checkpoints().is_staged()) return;
  const bool may_commit = !parts_.outbox.has_staged_records() &&
                          parts_.recorder.is_between_blocks() && parts_.recorder.fault().empty();
  if (may_commit) commit_state();
}

/// Before the record of the run's end, and in the same transaction.
void RunLoop::report_memory() {
  parts_.run.session->keep_memory(parts_.machine.status().executed);
  parts_.memory.stage();
  if (!parts_.memory.take_change()) return;
  for (const std::string& text : parts_.memory.report()) parts_.recorder.note_memory(text);
}

/// Reports are written as soon as the block they belong to is finished, or the machine is at rest.
void RunLoop::commit_reports() {
  ExecutionRecorder& recorder = parts_.recorder;
  const bool may_commit =
      recorder.is_between_blocks() || parts_.machine.state() != MachineState::Running;
  if (!parts_.outbox.has_staged_records() || !may_commit || !recorder.fault().empty()) return;
  (void)recorder.commit();
  if (recorder.fault().empty()) return;
  process::log_error("reports cannot be kept, the machine is held: {} {}", recorder.fault(),
                     parts_.run.label());
}

/// True: records cannot be written. The machine is held until they can.
bool RunLoop::wait_out_fault(SteadyTime now) {
  if (parts_.recorder.fault().empty()) return false;
  if (!is_held_by_fault_ && parts_.machine.state() == MachineState::Running) {
    parts_.machine.hold();
    is_held_by_fault_ = true;
  }
  if (now < next_commit_) return true;
  next_commit_ = now + kCommitRetry;
  if (!parts_.recorder.commit()) return true;
  process::log_info("reports are kept again {}", parts_.run.label());
  if (std::exchange(is_held_by_fault_, false) && parts_.consent.is_given())
    (void)parts_.machine.continue_unattended();
  return false;
}

void RunLoop::check_end() {
  const ExecutionRecorder& recorder = parts_.recorder;
  if (const auto& alarm = recorder.alarm()) {
    const std::string text = valid_text(alarm->text, kMaxReason);
    end(dds::RunOutcome::Alarmed, fmt::format("{} {}", alarm->id, text));
  } else if (recorder.was_aborted() && is_interrupted()) {
    end(dds::RunOutcome::Interrupted, why_interrupted_);
  } else if (recorder.was_aborted()) {
    end(dds::RunOutcome::Aborted,
        parts_.run.was_emergency_stopped ? "EMERGENCY STOP" : "aborted by command");
  } else if (recorder.has_ended() && parts_.machine.drained()) {
    end(dds::RunOutcome::Completed, "");
  }
}

void RunLoop::end(dds::RunOutcome outcome, const std::string& reason) {
  dds::RunEndText text;
  text.outcome = outcome;
  ended_as_ = outcome;
  text.reason = valid_text(reason, kMaxReason);
  const bool is_test = parts_.run.session->is_test();
  if (!is_test) text.motion_seconds = parts_.run.session->motion_seconds();
  const feed::ProgramFeed& feed = parts_.run.session->feed();
  if (feed.content_length() > 0) {
    text.content_sha256 = feed.content_digest().hex();
    text.content_length = feed.content_length();
  }
  const bool is_completed = outcome == dds::RunOutcome::Completed;
  parts_.run.last_execution =
      is_completed ? dds::Execution::ProgramCompleted : dds::Execution::Stopped;
  if (is_test) parts_.run.last_execution = dds::Execution::Ready;
  parts_.run.last_message = text.reason;
  if (is_completed) keep_tape();
  if (is_test) state_tape();
  if (!is_test) report_memory();
  stage_ending(outcome);
  parts_.recorder.end(std::move(text));
  parts_.consent.end_wait();
  parts_.run.is_ending = true;
  is_held_by_fault_ = false;
  try_to_finish(parts_.clock.steady_now());
}

void RunLoop::try_to_finish(SteadyTime now) {
  ExecutionRecorder& recorder = parts_.recorder;
  if (!recorder.fault().empty() && now < next_commit_) return;
  next_commit_ = now + kCommitRetry;
  if (const auto done = recorder.commit(); !done) {
    process::log_error("the end of the run cannot be kept yet: {} {}", done.error().what,
                       parts_.run.label());
    return;
  }
  const bool is_completed = ended_as_ == dds::RunOutcome::Completed;
  const std::string& message = parts_.run.last_message;
  const bool is_test = parts_.run.session->is_test();
  process::log_info("{} ended {}{}{} executed={} accepted={} sent={} {}",
                    is_test ? "test run" : "run",
                    is_completed || is_test ? dds::to_string(ended_as_) : "cut off",
                    message.empty() ? "" : ": ", message, recorder.executed().executed,
                    recorder.executed().accepted, recorder.executed().sent, parts_.run.label());
  recorder.finish();
  if (!is_test) {
    note_left();
    take_modes();
  }
  if (locked_at_) {
    parts_.machine.begin(locked_at_->at);
    parts_.run.tool = std::exchange(locked_at_, std::nullopt)->tool;
  }
  parts_.run.is_ending = false;
  parts_.run.session.reset();
  tested_memory_.reset();
  parts_.on_over();
}

void RunLoop::begin_interrupt(const std::string& reason) {
  why_interrupted_ = reason;
  if (parts_.run.is_active() && !is_testing()) parts_.machine.abort();
}

/// By nothing else.
bool RunLoop::is_interrupted() const {
  return !why_interrupted_.empty() && !is_aborted_by_command_ && !parts_.run.was_emergency_stopped;
}

/// With the emergency stop pressed the run would not end, and with a full disk it cannot.
bool RunLoop::may_be_interrupted() const {
  return !parts_.run.is_active() || is_testing() || parts_.machine.panel().emergency_stop ||
         !parts_.recorder.fault().empty();
}

Result<void> RunLoop::interrupt(const std::string& reason) {
  if (!parts_.run.session) return {};
  if (!parts_.run.is_ending) (void)parts_.machine.poll(machine::Seconds{0}, 0);  // its last reports
  if (!parts_.run.is_ending) end(dds::RunOutcome::Interrupted, reason);
  if (!parts_.run.session) return {};
  return fail(Errc::Io, "{}", parts_.recorder.fault());
}

bool RunLoop::is_moving() const {
  if (!parts_.run.is_active()) return false;
  if (parts_.machine.is_moving()) return true;
  // With the handwheel on, the program's time passes only by a command.
  return parts_.machine.state() == MachineState::Running && !parts_.machine.panel().handwheel;
}

bool RunLoop::waits_for_machine() const {
  if (!parts_.run.is_active() || parts_.consent.is_awaited()) return false;
  const auto waits = parts_.run.session->waits();
  return parts_.machine.state() == MachineState::Idle && waits != RunSession::Waits::ForText &&
         waits != RunSession::Waits::ForOperator;
}

Result<void> RunLoop::recover() {
  const auto& run = parts_.outbox.active_run();
  if (!run) {
    parts_.journal.clear();
    if (parts_.run.last_message.empty()) state_tape();
    return {};
  }
  // A block that reported something is executed when its record is committed, all others when the
  // journal has them.
  report::Progress progress = parts_.outbox.committed_progress();
  const auto entry = parts_.journal.read();
  if (entry && entry->run == run->run && entry->progress.executed >= progress.executed)
    progress = entry->progress;
  RunEnding ending;
  ending.executed = progress;
  resolve_interrupted(run->run, ending);
  progress = ending.executed;
  process::log_warning("run interrupted at block {}{} machine={} run={} program={}",
                       progress.executed, uncertain_text(ending), parts_.options.machine, run->run,
                       run->program);
  parts_.run.last_execution = dds::Execution::Stopped;
  parts_.run.last_message = fmt::format("run {} was interrupted at block {}{}", run->run,
                                        progress.executed, uncertain_text(ending));
  ending.time_us = parts_.clock.now().time_since_epoch().count();
  ending.memory = parts_.memory.digest();
  if (!ending.in_hand.empty() && !ending.rested_at) resting_ = Resting{run->run, ending, {}};
  parts_.outbox.checkpoints().stage_ending(run->run, encode(run->run, std::move(ending)));
  const bool has_memory = !parts_.outbox.memory().cells().empty() && parts_.memory.fault().empty();
  parts_.recorder.end_interrupted(run->run, progress,
                                  has_memory ? parts_.memory.report() : std::vector<std::string>());
  const auto done = parts_.outbox.commit();
  if (done) parts_.journal.clear();
  return done;
}

}  // namespace dripline::gateway
