#include <spdlog/spdlog.h>
#include <algorithm>
#include <limits>

#include "gateway/app/gateway.hpp"

/// The part of the gateway that moves the machine.
namespace dripline::gateway {

using machine::MachineState;
using std::chrono::milliseconds;

namespace {

constexpr std::size_t kBlocksPerRound = 256;
constexpr std::size_t kActionsPerRound = 512;
constexpr int kMaxRounds = 4096;  ///< bounds a slice even if the clock stands still
constexpr milliseconds kCommitRetry{500};
constexpr milliseconds kSyncInterval{1000};

}  // namespace

void Gateway::run_slice(SteadyTime now) {
  const auto elapsed = std::clamp<SteadyTime::duration>(now - last_step_, {}, kLongestStep);
  last_step_ = now;
  const auto& factor = parts_.options.speed.factor;
  double seconds = factor ? std::chrono::duration<double>(elapsed).count() * *factor
                          : std::numeric_limits<double>::infinity();
  if (wait_for_cycle_start(now)) return;
  if (wait_out_fault(now)) {
    (void)machine_.poll(machine::Seconds{seconds}, 0);  // comes to rest, begins nothing
    return;
  }
  SteadyTime deadline = now + kSlice;
  for (int round = 0; round < kMaxRounds; ++round) {
    if (!run_round(seconds, deadline)) break;
  }
  commit_reports();
  judge_end();
  if (now >= next_sync_) {
    next_sync_ = now + kSyncInterval;
    keep_memory();
    if (const auto done = parts_.journal.sync(); !done)
      spdlog::warn("{} {}", done.error().what, label());
  }
}

/// Some blocks in, some actions out. False: nothing more can be done in this slice.
bool Gateway::run_round(double& machine_seconds, SteadyTime& deadline) {
  if (recorder_.alarm() || recorder_.was_aborted()) return false;  // nothing more counts
  const std::size_t blocks = session_->fill(kBlocksPerRound);
  const machine::MachineStatus before = machine_.status();
  const double used = machine_.poll(machine::Seconds{machine_seconds}, kActionsPerRound).count();
  machine_seconds -= used;
  const bool has_advanced = used > 0 || machine_.status().queued != before.queued;
  const bool can_go_on = (blocks > 0 || has_advanced) && machine_seconds > 0;
  return can_go_on && recorder_.trouble().empty() && parts_.clock.steady_now() < deadline;
}

/// What executed blocks have changed in the control's memory goes to disk with the next reports, or
/// by itself: a kill loses what the last kSyncInterval has changed.
void Gateway::keep_memory() {
  if (!session_ || is_ending_) return;
  session_->keep_memory(machine_.status().executed);
  if (!memory_.has_unstaged()) return;
  memory_.stage();
  const bool has_reports = outbox_.has_staged_records();
  if (!has_reports && recorder_.is_between_blocks() && recorder_.trouble().empty())
    (void)recorder_.commit();
}

/// Before the record of the run's end, and with it.
void Gateway::report_memory() {
  session_->keep_memory(machine_.status().executed);
  memory_.stage();
  if (!memory_.take_change()) return;
  for (const std::string& text : memory_.report()) recorder_.note_memory(text);
}

/// What was reported goes to disk as soon as the block it belongs to is finished, or stands still.
void Gateway::commit_reports() {
  const bool may_commit =
      recorder_.is_between_blocks() || machine_.state() != MachineState::Running;
  if (!outbox_.has_staged_records() || !may_commit || !recorder_.trouble().empty()) return;
  (void)recorder_.commit();
  if (recorder_.trouble().empty()) return;
  spdlog::error("reports cannot be kept, the machine is held: {} {}", recorder_.trouble(), label());
}

/// True: records cannot be written. The machine stands until they can.
bool Gateway::wait_out_fault(SteadyTime now) {
  if (recorder_.trouble().empty()) return false;
  if (!is_held_by_fault_ && machine_.state() == MachineState::Running) {
    machine_.hold();
    is_held_by_fault_ = true;
  }
  if (now < next_commit_) return true;
  next_commit_ = now + kCommitRetry;
  if (!recorder_.commit()) return true;
  spdlog::info("reports are kept again {}", label());
  if (std::exchange(is_held_by_fault_, false) && consent_.is_given()) machine_.resume();
  return false;
}

void Gateway::judge_end() {
  if (const auto& alarm = recorder_.alarm()) {
    const std::string text = valid_text(alarm->text, kMaxReason);
    end_run(dds::RunOutcome::Alarmed, fmt::format("{} {}", alarm->id, text));
  } else if (recorder_.was_aborted()) {
    end_run(dds::RunOutcome::Aborted,
            was_emergency_stopped_ ? "EMERGENCY STOP" : "aborted by order");
  } else if (recorder_.has_ended() && machine_.drained()) {
    end_run(dds::RunOutcome::Completed, "");
  }
}

void Gateway::end_run(dds::RunOutcome outcome, const std::string& reason) {
  dds::RunEndText end;
  end.outcome = outcome;
  end.reason = valid_text(reason, kMaxReason);
  const feed::ProgramFeed& feed = session_->feed();
  if (feed.content_length() > 0) {
    end.content_sha256 = feed.content_digest().hex();
    end.content_length = feed.content_length();
  }
  const bool is_completed = outcome == dds::RunOutcome::Completed;
  last_execution_ = is_completed ? dds::Execution::ProgramCompleted : dds::Execution::Stopped;
  last_message_ = end.reason;
  report_memory();
  recorder_.end(std::move(end));
  consent_.end_wait();
  is_ending_ = true;
  is_held_by_fault_ = false;
  try_to_finish(parts_.clock.steady_now());
}

void Gateway::try_to_finish(SteadyTime now) {
  if (!recorder_.trouble().empty() && now < next_commit_) return;
  next_commit_ = now + kCommitRetry;
  if (const auto done = recorder_.commit(); !done) {
    spdlog::error("the end of the run cannot be kept yet: {} {}", done.error().what, label());
    return;
  }
  spdlog::info("run ended {}{} executed={} accepted={} sent={} {}",
               last_execution_ == dds::Execution::ProgramCompleted ? "completed" : "cut off: ",
               last_message_, recorder_.executed().executed, recorder_.executed().accepted,
               recorder_.executed().sent, label());
  recorder_.finish();
  is_ending_ = false;
  line_feed_ = nullptr;
  session_.reset();
  line_run_over();
}

Result<void> Gateway::interrupt_run(const std::string& reason) {
  if (!session_) return {};
  if (!is_ending_) end_run(dds::RunOutcome::Interrupted, reason);
  if (!session_) return {};
  return fail(Errc::Io, "{}", recorder_.trouble());
}

}  // namespace dripline::gateway
