#include "gateway/app/serial/serial_run.hpp"

#include <utility>

#include "gateway/app/run/run_texts.hpp"
#include "gateway/line/inbound/program_head.hpp"
#include "gateway/line/line_words.hpp"
#include "gateway/line/port_transfer.hpp"
#include "protocol/dds/record_text.hpp"
#include "protocol/process/log.hpp"

namespace dripline::gateway {
namespace {

constexpr std::chrono::milliseconds kSerialSyncInterval{1000};
dds::RunOutcome to_outcome(line::SendOutcome outcome) {
  if (outcome == line::SendOutcome::Completed) return dds::RunOutcome::Completed;
  if (outcome == line::SendOutcome::Aborted) return dds::RunOutcome::Aborted;
  return dds::RunOutcome::Interrupted;
}

}  // namespace

bool is_begun_at_control(const wire::LineSettings& settings) {
  switch (settings.flow) {
    case wire::Flow::DcCodes:
    case wire::Flow::Xmodem:
    case wire::Flow::Heidenhain:
    case wire::Flow::HeidenhainBcc:
    case wire::Flow::TapeReader:
      return true;
    default:
      return settings.wait_for_xon;
  }
}

std::string SerialRun::label() const {
  const std::string& machine = parts_.options.machine;
  if (!current_) return fmt::format("machine={}", machine);
  return fmt::format("machine={} run={} program={}", machine, current_->run.run,
                     current_->run.program);
}

Result<void> SerialRun::recover() {
  const auto& run = parts_.outbox.active_run();
  if (!run) {
    journal_.clear();
    return {};
  }
  report::Progress progress = parts_.outbox.committed_progress();
  const auto entry = journal_.read();
  if (entry && entry->run == run->run) progress = entry->progress;
  is_program_broken_ = progress.offset > 0;
  const std::string reason =
      fmt::format("the gateway was cut off; at least {} bytes were sent, at most {}; {}",
                  progress.sent, std::max(progress.offset, progress.sent),
                  line::place_words(progress.line, progress.sequence, "sent"));
  process::log_warning("run interrupted: {} machine={} run={} program={}", reason,
                       parts_.options.machine, run->run, run->program);
  current_.emplace(Current{.run = *run, .text = nullptr});
  end(dds::RunOutcome::Interrupted, reason, progress);
  if (!current_) return {};
  return fail(Errc::Io, "{}", parts_.records.fault());
}

Result<void> SerialRun::check_line() const {
  const auto view = port_->view();
  if (!view.is_open) {
    return fail(Errc::Timeout, "line {} is not open: {}", view.names.address,
                view.fault.empty() ? "not yet" : view.fault);
  }
  if (port_->is_busy())
    return fail(Errc::Busy, "line {} is busy: it is {}", view.names.address, what_it_does(view));
  return {};
}

/// A request that came before the start is no consent to it.
bool SerialRun::must_wait_for_panel() const {
  if (parts_.consent.is_given()) return false;
  return !is_begun_at_control(parts_.settings) || port_->view().line.is_asked;
}

Result<void> SerialRun::start(const dds::Command& command, SteadyTime now) {
  if (!parts_.records.fault().empty())
    return fail(Errc::Busy, "reports cannot be kept: {}", parts_.records.fault());
  if (auto free = port_->drop_answer(); !free) return free;
  if (auto ready = check_line(); !ready) return ready;
  const auto argument = parse_start_argument(command.argument);
  if (!argument) return fail(argument.error());
  if (argument->restart)
    return fail(Errc::Unsupported, "over this line a restart is a start with from and head");
  if (argument->is_mdi)
    return fail(Errc::Unsupported, "MDI is the control's own: nothing is keyed in over this line");
  if (argument->is_test)
    return fail(Errc::Unsupported,
                "this machine's control is at the end of a line and would execute the program: it "
                "has no test run (dnc check looks through a program without a machine)");
  auto place = SerialStart::make(*argument, {command.control, command.size});
  if (!place) return fail(place.error());
  const report::ActiveRun run{command.run, command.program, command.revision, command.control,
                              command.size};
  parts_.outbox.begin_run(run);
  parts_.records.append(
      {.kind = dds::RecordKind::RunStarted,
       .run = run.run,
       .text = dds::encode(dds::RunStartText{run.program, run.revision, run.control})});
  parts_.commands.stage_start(run.run, command.id);
  if (auto kept = parts_.records.commit(); !kept) {
    parts_.records.discard();
    return fail(kept.error().code, "the start cannot be kept: {}", kept.error().what);
  }
  auto text = std::make_shared<PulledText>(
      feed::FeedRun{parts_.options.machine, parts_.session, run.run, run.size},
      PulledText::buffer_for(wire::characters_per_second(parts_.settings),
                             parts_.options.line->ahead),
      [this](const dds::BlockRequest& request) {
        return parts_.endpoint.write(request).has_value();
      });
  current_.emplace(Current{.run = run, .text = std::move(text), .start = *std::move(place)});
  journal_.begin(run.run);
  last_run_ = run.run;
  last_message_.clear();
  look_for_beginning(now);
  return {};
}

/// A piece of the look through the program. Nothing leaves before it is over.
void SerialRun::look_for_beginning(SteadyTime now) {
  SerialStart& start = *current_->start;
  const auto state = start.work(*current_->text);
  if (state == SerialStart::State::Failed) return end(dds::RunOutcome::Aborted, start.fault(), {});
  if (state == SerialStart::State::Ready) begin(now);
}

void SerialRun::begin(SteadyTime now) {
  if (!current_->start->head().empty())
    port_->note("sent before the program: " + current_->start->head());
  if (current_->is_held) {
    parts_.consent.await_confirmation(now + parts_.options.cycle_start_wait);
  } else if (must_wait_for_panel()) {
    parts_.consent.await(now + parts_.options.cycle_start_wait);
  } else {
    begin_on_line();
  }
}

bool SerialRun::is_looking() const {
  return current_ && current_->start && !current_->start->is_ready();
}

std::string SerialRun::head() const {
  return current_ && current_->start ? current_->start->head() : std::string();
}

void SerialRun::begin_on_line() {
  parts_.consent.end_wait();
  line::SendJob job;
  job.id = current_->run.run;
  job.name = line::has_numbered_programs(parts_.settings.flow)
                 ? line::program_number(current_->run.program)
                 : current_->run.program;
  job.source = current_->text;
  job.size = current_->run.size;
  job.head = current_->start->head();
  job.first_byte = current_->start->place().byte;
  job.first_line = current_->start->place().line;
  current_->is_on_line = true;
  process::log_info("run begins on the line {}", label());
  port_->begin(std::move(job), [this, run = current_->run.run](const Result<void>& begun) {
    if (begun || !current_ || current_->run.run != run) return;
    end(dds::RunOutcome::Interrupted, begun.error().what, {});
  });
}

void SerialRun::on_data(const dds::BlockData& data, SteadyTime now) {
  if (!current_ || !current_->text) return;
  current_->text->feed().on_data(data, now);
  if (current_->is_on_line) port_->on_text();
}

void SerialRun::ask_again() {
  if (current_ && current_->text) current_->text->feed().ask_again();
}

void SerialRun::poll(SteadyTime now) {
  if (!current_) return;
  if (current_->is_ending) {
    if (!parts_.records.has_staged() && parts_.records.fault().empty()) finish();
    return;
  }
  current_->text->feed().poll(now);
  const std::string& failure = current_->text->feed().failure();
  if (!failure.empty() && !current_->is_on_line)
    return end(dds::RunOutcome::Interrupted, failure, {});
  if (!failure.empty()) port_->on_text();
  if (is_looking()) return look_for_beginning(now);
  if (parts_.consent.is_awaited() && parts_.consent.is_overdue(now)) {
    return end(dds::RunOutcome::Aborted,
               fmt::format("no cycle start at the machine within {} s",
                           parts_.options.cycle_start_wait.count()),
               {});
  }
  if (now < next_sync_) return;
  next_sync_ = now + kSerialSyncInterval;
  if (const auto done = journal_.sync(); !done)
    process::log_warning("{} {}", done.error().what, label());
}

std::optional<SteadyTime> SerialRun::next_poll() const {
  if (!current_ || !current_->text || current_->is_ending) return std::nullopt;
  return current_->text->feed().next_poll();
}

Result<void> SerialRun::cycle_start() {
  if (is_looking())
    return fail(Errc::Busy, "the program is still looked through for its beginning");
  if (!parts_.consent.is_awaited()) return resume();
  if (auto ready = check_line(); !ready) return ready;
  begin_on_line();
  return {};
}

Result<void> SerialRun::hold() {
  if (!current_->is_on_line) {  // nothing of it leaves before cycle start
    current_->is_held = true;
    return {};
  }
  port_->hold(current_->run.run, [](const Result<void>&) {});
  return {};
}

Result<void> SerialRun::resume() {
  if (parts_.consent.is_awaited()) return cycle_start();
  if (is_looking() && current_->is_held) {
    current_->is_held = false;
    return {};
  }
  const auto now = port_->progress();
  if (!now || !now->is_held) return fail(Errc::Conflict, "the run is not held");
  port_->resume(current_->run.run, [](const Result<void>&) {});
  return {};
}

void SerialRun::abort(const std::string& reason) {
  if (!current_ || current_->is_ending) return;
  if (!current_->is_on_line) return end(dds::RunOutcome::Aborted, reason, {});
  port_->abort(current_->run.run, reason, [](const Result<void>&) {});
}

void SerialRun::interrupt(const std::string& reason) {
  if (current_ && !current_->is_ending) end(dds::RunOutcome::Interrupted, reason, {});
}

void SerialRun::on_sent(const line::SendEnd& sent) {
  if (!current_ || sent.progress.id != current_->run.run) return;
  const bool is_completed = sent.outcome == line::SendOutcome::Completed;
  end(to_outcome(sent.outcome), is_completed ? std::string(line::kSentToItsEnd) : sent.reason,
      LineJournal::progress_of(sent.progress));
}

void SerialRun::end(dds::RunOutcome outcome, const std::string& reason,
                    const report::Progress& progress) {
  dds::RunEndText text;
  text.outcome = outcome;
  text.reason = valid_text(reason, kMaxReason);
  text.sent = progress.sent;
  text.accepted = progress.accepted;
  text.line = progress.line;
  text.sequence = progress.sequence;
  if (current_->text && current_->text->feed().content_length() > 0) {
    text.content_sha256 = current_->text->feed().content_digest().hex();
    text.content_length = current_->text->feed().content_length();
  }
  const bool is_completed = outcome == dds::RunOutcome::Completed;
  last_execution_ = is_completed ? dds::Execution::ProgramCompleted : dds::Execution::Stopped;
  last_message_ = is_completed ? std::string() : text.reason;
  process::log_info("run ended {}: {} sent={} accepted={} {}", dds::to_string(outcome), text.reason,
                    text.sent, text.accepted, label());
  parts_.outbox.note_progress(progress);
  parts_.records.append(
      {.kind = dds::RecordKind::RunEnded, .run = current_->run.run, .text = dds::encode(text)});
  parts_.outbox.end_run();
  parts_.consent.end_wait();
  current_->is_ending = true;
  if (parts_.records.commit()) finish();
}

void SerialRun::finish() {
  journal_.clear();
  current_.reset();
}

line::SendProgress SerialRun::progress() const {
  if (current_ && current_->is_on_line) {
    const auto now = port_->progress();
    if (now && now->id == current_->run.run) return *now;
  }
  return {};
}

std::uint64_t SerialRun::buffered_bytes() const {
  if (!current_ || !current_->text) return 0;
  return current_->text->bytes_ahead() + (current_->is_on_line ? port_->text_ahead() : 0);
}

double SerialRun::seconds_of(std::uint64_t bytes) const {
  return static_cast<double>(bytes) / wire::characters_per_second(parts_.settings);
}

bool SerialRun::has_all_text() const {
  return current_ && current_->text && current_->text->is_complete();
}

}  // namespace dripline::gateway
