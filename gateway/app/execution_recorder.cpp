#include "gateway/app/execution_recorder.hpp"

#include <utility>

#include "gateway/interpreter/core/event.hpp"

namespace dripline::gateway {

using dds::RecordKind;

void ExecutionRecorder::begin(const report::ActiveRun& run, const std::string& setup,
                              ProgressOf feed_progress) {
  run_ = run.run;
  feed_progress_ = std::move(feed_progress);
  reached_ = counted_ = {};
  path_mm_ = 0;
  outputs_ = 0;
  is_between_blocks_ = true;
  clear_notice();
  probed_.reset();
  alarm_.reset();
  has_ended_ = was_aborted_ = false;
  parts_.execution_probe.reset();
  if (parts_.motion_journal != nullptr) parts_.motion_journal->begin(run.run);
  parts_.outbox.begin_run(run);
  append({}, {RecordKind::RunStarted,
              {},
              dds::encode(dds::RunStartText{run.program, run.revision, run.control, setup})});
}

void ExecutionRecorder::continue_after(const interpreter::Origin& origin) {
  const FeedProgress now = feed_progress_(origin.block);
  reached_ = {now.sent,        now.accepted,  origin.block, origin.line,
              origin.sequence, origin.offset, now.path};
}

void ExecutionRecorder::end(dds::RunEndText end) {
  const FeedProgress now = feed_progress_(reached_.executed);
  reached_.sent = now.sent;
  reached_.accepted = now.accepted;
  if (end.motion_seconds) end.path_mm = path_mm_;
  append_end(std::move(end));
}

void ExecutionRecorder::end_interrupted(const std::string& run, const report::Progress& progress,
                                        const std::vector<std::string>& memory) {
  run_ = run;
  reached_ = progress;
  for (const std::string& text : memory) note_memory(text);
  dds::RunEndText end;
  end.outcome = dds::RunOutcome::Interrupted;
  end.reason = "the gateway was cut off";
  append_end(std::move(end));
  run_.clear();
}

/// The counters and the place are those that were reached.
void ExecutionRecorder::append_end(dds::RunEndText end) {
  end.sent = reached_.sent;
  end.accepted = reached_.accepted;
  end.executed = reached_.executed;
  end.line = reached_.line;
  end.sequence = reached_.sequence;
  append(reached_origin(), {RecordKind::RunEnded, {}, dds::encode(end)});
  parts_.outbox.end_run();
}

interpreter::Origin ExecutionRecorder::reached_origin() const {
  interpreter::Origin origin;
  origin.block = reached_.executed;
  origin.line = reached_.line;
  origin.sequence = reached_.sequence;
  return origin;
}

void ExecutionRecorder::finish() {
  parts_.journal.clear();
  cancel();
}

void ExecutionRecorder::cancel() {
  run_.clear();
  feed_progress_ = nullptr;
}

Result<void> ExecutionRecorder::commit() {
  parts_.outbox.note_progress(reached_);
  parts_.execution_probe.begin(reached_.executed, outputs_);
  const auto done = parts_.outbox.commit();
  fault_ = done ? std::string() : done.error().what;
  if (!done) return done;
  count();
  return {};
}

void ExecutionRecorder::count() {
  if (counted_ != reached_) parts_.journal.write(reached_);
  counted_ = reached_;
  parts_.execution_probe.finish();
}

void ExecutionRecorder::on_given(const machine::GivenAction& action) {
  if (parts_.motion_journal == nullptr || !feed_progress_) return;
  const interpreter::Origin& origin = action.origin;
  const FeedProgress now = feed_progress_(origin.block);
  parts_.motion_journal->write({{now.sent, now.accepted, origin.block, origin.line, origin.sequence,
                                 origin.offset, now.path},
                                action});
}

void ExecutionRecorder::on_block_executed(const interpreter::Origin& origin) {
  if (!feed_progress_) return;  // of no run
  const FeedProgress feed_progress = feed_progress_(origin.block);
  reached_ = {feed_progress.sent, feed_progress.accepted, origin.block,      origin.line,
              origin.sequence,    origin.offset,          feed_progress.path};
  path_mm_ = feed_progress.path_mm;
  is_between_blocks_ = true;
  if (!parts_.outbox.has_staged_records()) {
    parts_.execution_probe.begin(reached_.executed, outputs_);
    count();
  } else if (parts_.outbox.staged_records() >= kMaxBatch && fault_.empty()) {
    (void)commit();  // a failure is kept in fault()
  }
}

bool ExecutionRecorder::on_motion_starts(const interpreter::Origin&) {
  if (is_between_blocks_ && fault_.empty() && parts_.outbox.has_staged_records()) (void)commit();
  return fault_.empty();
}

void ExecutionRecorder::append(const interpreter::Origin& origin, Report report) {
  dds::Record record;
  record.machine = parts_.machine;
  record.time = parts_.clock.now();
  record.run = run_;
  record.kind = report.kind;
  record.block = origin.block;
  record.line = origin.line;
  record.sequence = origin.sequence;
  record.device = std::move(report.device);
  record.text = valid_text(report.text, dds::kMaxRecordText);
  parts_.outbox.append(std::move(record));
}

void ExecutionRecorder::on_output(const interpreter::Output& output) {
  ++outputs_;
  is_between_blocks_ = false;
  append(output.origin, {RecordKind::Output, std::string(interpreter::word_of(output.device)),
                         std::string(output.text)});
  if (parts_.on_output) parts_.on_output(output);
}

void ExecutionRecorder::on_open(const interpreter::Open& open) {
  append(open.origin, {RecordKind::DeviceOpened, std::string(interpreter::word_of(open.device)),
                       std::string(open.name.value_or(""))});
}

void ExecutionRecorder::on_close(const interpreter::Close& close) {
  append(close.origin,
         {RecordKind::DeviceClosed, std::string(interpreter::word_of(close.device)), {}});
}

void ExecutionRecorder::on_message(const interpreter::Message& message) {
  message_ = valid_text(message.text, dds::kMaxRecordText);
  append(message.origin, {RecordKind::Message, {}, message_});
}

void ExecutionRecorder::on_warning(const interpreter::Warning& warning) {
  append(warning.origin,
         {RecordKind::Warning, {}, dds::encode(diagnostic_text(warning.diagnostic))});
}

void ExecutionRecorder::on_probed(const interpreter::Probe& probe) {
  probed_ = probe;
  append(probe.origin, {RecordKind::Probe, {}, dds::encode(probe_text(probe))});
}

/// A pulse ends by itself, at the state before it.
void ExecutionRecorder::on_pin(const interpreter::PinChange& pin) {
  switched_[{pin.axis, pin.output}] = pin.pulse_ms ? !pin.state : pin.state;
}

void ExecutionRecorder::on_miscellaneous(const interpreter::Miscellaneous& function) {
  functions_.push_front({function.code, function.e, function.p, function.q});
  if (functions_.size() > kMaxCodes) functions_.pop_back();
  const bool is_analog = function.code == 67 || function.code == 68;
  if (is_analog && function.e && function.q) analog_[static_cast<int>(*function.e)] = *function.q;
}

void ExecutionRecorder::on_stop(const interpreter::Stop& stop) {
  const std::string_view text = to_text(stop.kind);
  // Only the latest stop applies: an earlier one, such as a tool change without a wait, is over.
  notice_ = std::string(text);
  if (!message_.empty()) notice_ += ": " + message_;
  append(stop.origin, {RecordKind::Stop, {}, std::string(text)});
}

void ExecutionRecorder::on_alarm(const interpreter::Alarm& alarm) {
  alarm_ = alarm.diagnostic;
  append(alarm.origin, {RecordKind::Alarm, {}, dds::encode(diagnostic_text(alarm.diagnostic))});
}

void ExecutionRecorder::on_end(const interpreter::End&) {
  has_ended_ = true;
}

void ExecutionRecorder::on_aborted() {
  was_aborted_ = true;
}

void ExecutionRecorder::note_emergency_stop(const interpreter::Origin& origin) {
  append(origin, {RecordKind::Stop, {}, "emergency stop"});
}

void ExecutionRecorder::note_memory(const std::string& text) {
  append(reached_origin(), {RecordKind::Message, kMemoryDevice, text});
}

void ExecutionRecorder::note_memory_change(const std::string& change,
                                           const std::vector<std::string>& texts) {
  run_ = change;
  for (const std::string& text : texts) append({}, {RecordKind::Message, kMemoryDevice, text});
  run_.clear();
}

void ExecutionRecorder::note_restart(const std::string& text) {
  append(reached_origin(), {RecordKind::Message, kRestartDevice, text});
}

void ExecutionRecorder::note(const interpreter::Origin& origin, const std::string& text) {
  append(origin, {RecordKind::Message, {}, text});
}

void ExecutionRecorder::note_at_panel(const interpreter::Origin& origin, const std::string& text) {
  append(origin, {RecordKind::Message, {}, "at the machine's panel: " + text});
}

}  // namespace dripline::gateway
