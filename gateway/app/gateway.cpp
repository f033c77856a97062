#include "gateway/app/gateway.hpp"

#include <spdlog/spdlog.h>
#include <algorithm>
#include <utility>

namespace dripline::gateway {
Gateway::Gateway(Parts parts)
    : parts_(std::move(parts)),
      outbox_(parts_.outbox),
      recorder_({parts_.options.machine, parts_.outbox, parts_.journal, parts_.execution_probe,
                 parts_.clock,
                 [this](const interpreter::Output& output) { print_on_line(output); }}),
      memory_(parts_.outbox),
      motion_(parts_.make_motion(recorder_)),
      machine_(*motion_),
      sender_(
          parts_.options.machine, parts_.outbox, {},
          [this](const dds::Record& record) { return parts_.endpoint.write(record).has_value(); }),
      publisher_(
          [this](const dds::Status& status) { return parts_.endpoint.write(status).has_value(); }),
      validity_(parts_.session),
      consent_(parts_.options.is_unattended) {
  machine::OperatorPanel panel;
  panel.single_block = parts_.setup.switches.single_block;
  panel.optional_stop = parts_.setup.switches.optional_stop;
  panel.block_skip = parts_.setup.switches.block_skip;
  machine_.set_panel(panel);
  machine_.begin(parts_.setup.start);
  take_panel_tables(parts_.setup);
  if (parts_.options.line) line_request_ = parts_.options.line->request;
}

Result<void> Gateway::recover() {
  if (auto fits = check_speed(machine_.capabilities(), parts_.options.speed); !fits) return fits;
  if (!memory_.fault().empty()) {
    last_message_ = valid_text(memory_.fault(), kMaxReason);
    spdlog::error("{}: no program is begun until the memory is discarded at the panel {}",
                  memory_.fault(), label());
  }
  const auto& run = outbox_.active_run();
  if (!run) {
    parts_.journal.clear();
    return {};
  }
  // A block that reported something counts with its record, all others with the journal.
  report::Progress progress = outbox_.committed_progress();
  const auto entry = parts_.journal.read();
  if (entry && entry->run == run->run && entry->progress.executed >= progress.executed)
    progress = entry->progress;

  dds::RunEndText end;
  end.outcome = dds::RunOutcome::Interrupted;
  end.sent = progress.sent;
  end.accepted = progress.accepted;
  end.executed = progress.executed;
  end.line = progress.line;
  end.sequence = progress.sequence;
  end.reason = "the gateway was cut off";
  dds::Record record;
  record.machine = parts_.options.machine;
  record.time = parts_.clock.now();
  record.run = run->run;
  record.kind = dds::RecordKind::RunEnded;
  record.block = progress.executed;
  record.line = progress.line;
  record.sequence = progress.sequence;
  record.text = dds::encode(end);
  spdlog::warn("run interrupted at block {} machine={} run={} program={}", progress.executed,
               parts_.options.machine, run->run, run->program);
  last_execution_ = dds::Execution::Stopped;
  last_message_ = fmt::format("run {} was interrupted at block {}", run->run, progress.executed);
  dds::Record kept = record;
  kept.kind = dds::RecordKind::Message;
  kept.device = ExecutionRecorder::kMemoryDevice;
  const bool is_told = !outbox_.memory().empty() && memory_.fault().empty();
  const auto memory = is_told ? memory_.report() : std::vector<std::string>();
  for (const std::string& text : memory) {
    kept.text = text;
    outbox_.append(kept);
  }
  outbox_.append(std::move(record));
  outbox_.end_run();
  const auto done = outbox_.commit();
  if (done) parts_.journal.clear();
  return done;
}

void Gateway::receive(Incoming incoming, SteadyTime now) {
  if (const auto* command = std::get_if<dds::Command>(&incoming)) {
    on_command(*command);
  } else if (const auto* ack = std::get_if<dds::RecordAck>(&incoming)) {
    sender_.on_ack(*ack, now);
  } else if (const auto* data = std::get_if<dds::BlockData>(&incoming)) {
    if (session_) session_->feed().on_data(*data, now);
  } else if (const auto* seen = std::get_if<ServerSeen>(&incoming)) {
    spdlog::info("server {} machine={}", seen->is_connected ? "connected" : "gone",
                 parts_.options.machine);
    is_connected_ = seen->is_connected;
    refused_by_server_.clear();
    sender_.on_server(is_connected_);
    if (!is_connected_) return;
    announcement_is_due_ = true;
    publisher_.reset();
    if (session_) session_->feed().ask_again();
  } else if (const auto* request = std::get_if<PanelRequest>(&incoming)) {
    on_panel(*request);
  } else if (const auto* stop = std::get_if<StopRequested>(&incoming)) {
    spdlog::info("stopping on signal {} machine={}", stop->signal, parts_.options.machine);
    stop_requested_ = true;
  }
}

SteadyTime Gateway::turn(SteadyTime now) {
  announce();
  serve_line(now);
  if (session_) {
    session_->feed().poll(now);
    if (is_ending_) {
      try_to_finish(now);
    } else {
      run_slice(now);
    }
  }
  send_results();
  const std::uint64_t unsent = outbox_.unacknowledged();
  if (const auto done = sender_.poll(now); !done) {
    spdlog::error("outbox of {} records machine={}: {}", unsent, parts_.options.machine,
                  done.error().what);
  }
  if (sender_.take_epoch_change()) {
    spdlog::warn("record numbers begin anew, epoch {} machine={}", outbox_.epoch(),
                 parts_.options.machine);
    announcement_is_due_ = true;
  }
  if (publisher_.is_due(now)) {
    if (session_) session_->size_feed(parts_.options.speed.factor);
    publisher_.offer(status(), now);
    log_rejected(now);
  }
  return next_turn(now);
}

bool Gateway::is_running() const {
  if (!session_ || is_ending_) return false;
  if (machine_.is_moving()) return true;
  // A handwheel at rest is an order that has not come.
  return machine_.state() == machine::MachineState::Running && !machine_.panel().handwheel;
}

SteadyTime Gateway::next_turn(SteadyTime now) const {
  if (is_running()) return parts_.options.speed.factor ? now + kTick : now;
  constexpr std::chrono::milliseconds kSoon{20};
  const bool has_work = session_ || announcement_is_due_ || !results_.empty();
  SteadyTime next =
      now + (has_work ? report::StatusPublisher::kShortest : report::StatusPublisher::kHeartbeat);
  if (announcement_is_due_ || !results_.empty()) next = std::min(next, now + kSoon);
  // Whatever waits for the machine's next step (a probe's answer, the next block) waits shortly.
  const bool waits_for_machine = session_ && !is_ending_ && !consent_.is_awaited() &&
                                 machine_.state() == machine::MachineState::Idle &&
                                 session_->waits() != RunSession::Waits::ForText &&
                                 session_->waits() != RunSession::Waits::ForOperator;
  if (waits_for_machine) return parts_.options.speed.factor ? now + kTick : now;
  if (const auto poll = sender_.next_poll()) next = std::min(next, *poll);
  if (session_) {
    if (const auto poll = session_->feed().next_poll()) next = std::min(next, *poll);
  }
  if (listen_at_) next = std::min(next, *listen_at_);
  if (line_ == Line::Draining) next = std::min(next, now + report::StatusPublisher::kShortest);
  return std::max(next, now + std::chrono::milliseconds(1));
}

/// What was dropped is told at most once a minute: whoever sends it must not fill the log.
void Gateway::log_rejected(SteadyTime now) {
  constexpr std::chrono::minutes kInterval{1};
  const dds::Rejected dropped = parts_.endpoint.rejected();
  if (dropped.messages == rejected_logged_ || now < next_rejected_log_) return;
  spdlog::warn("dropped {} DDS messages, the last: {} {}", dropped.messages - rejected_logged_,
               dropped.last_reason, label());
  rejected_logged_ = dropped.messages;
  next_rejected_log_ = now + kInterval;
}

void Gateway::announce() {
  if (!announcement_is_due_) return;
  dds::Announce message;
  message.machine = parts_.options.machine;
  message.control = parts_.options.control;
  message.version = DRIPLINE_VERSION;
  message.epoch = outbox_.epoch();
  message.session = parts_.session;
  message.description = parts_.options.description;
  announcement_is_due_ = !parts_.endpoint.write(message).has_value();
}

std::string Gateway::label() const {
  if (!session_) return fmt::format("machine={}", parts_.options.machine);
  return fmt::format("machine={} run={} program={}", parts_.options.machine, session_->run().run,
                     session_->run().program);
}

}  // namespace dripline::gateway
