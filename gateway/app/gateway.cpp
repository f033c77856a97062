#include "gateway/app/gateway.hpp"

#include <algorithm>
#include <utility>

#include "protocol/process/log.hpp"

namespace dripline::gateway {

Gateway::Gateway(Parts parts)
    : parts_(std::move(parts)),
      outbox_(parts_.outbox),
      server_({.options = parts_.options,
               .endpoint = parts_.endpoint,
               .outbox = parts_.outbox,
               .session = parts_.session}),
      run_{.machine = parts_.options.machine, .session = nullptr, .last_message = {}},
      recorder_({.machine = parts_.options.machine,
                 .outbox = parts_.outbox,
                 .journal = parts_.journal,
                 .motion_journal = parts_.motion_journal,
                 .execution_probe = parts_.execution_probe,
                 .clock = parts_.clock,
                 .on_output =
                     [this](const interpreter::Output& output) {
                       if (line_) line_->print(output);
                     }}),
      memory_(parts_.outbox.memory()),
      machine_(parts_.make_motion(recorder_)),
      consent_(parts_.options.is_unattended),
      validity_(parts_.session),
      commands_(parts_.options.machine, parts_.outbox, parts_.endpoint),
      emergency_stop_(parts_.kept_emergency_stop),
      panel_({.dialect = parts_.dialect,
              .machine = *machine_,
              .recorder = recorder_,
              .run = run_,
              .consent = consent_,
              .emergency_stop = emergency_stop_}),
      loop_({.options = parts_.options,
             .dialect = parts_.dialect,
             .setup = parts_.setup,
             .setup_digest = parts_.setup_digest,
             .keeps_checkpoints = parts_.line == nullptr,
             .clock = parts_.clock,
             .outbox = parts_.outbox,
             .journal = parts_.journal,
             .motion_journal = parts_.motion_journal,
             .machine = *machine_,
             .recorder = recorder_,
             .memory = memory_,
             .commands = commands_,
             .consent = consent_,
             .run = run_,
             .on_begin =
                 [this](const interpreter::Setup& setup) {
                   panel_.take_tables(setup);
                   status_.take_settings(setup);
                 },
             .on_over =
                 [this] {
                   if (line_) line_->on_run_over();
                   server_.want_status();
                 },
             .serve_panel = [this] { serve_stops(); }}),
      positions_({.dialect = parts_.dialect,
                  .setup = parts_.setup,
                  .machine = *machine_,
                  .memory = memory_,
                  .run = run_}),
      jogger_({.options = parts_.options,
               .dialect = parts_.dialect,
               .setup = parts_.setup,
               .clock = parts_.clock,
               .machine = *machine_,
               .positions = positions_,
               .consent = consent_,
               .run = run_,
               .has_line = parts_.line != nullptr}),
      status_({.gateway_session = parts_.session,
               .dialect = parts_.dialect,
               .setup = parts_.setup,
               .clock = parts_.clock,
               .machine = *machine_,
               .outbox = parts_.outbox,
               .recorder = recorder_,
               .consent = consent_,
               .run = run_}) {
  panel_.begin(parts_.setup);
  machine_->begin(parts_.setup.start);
  if (parts_.line == nullptr) return;
  line_ = std::make_unique<LineOperator>(LineOperator::Parts{
      .line = *parts_.line,
      .control = parts_.options.control,
      .request = parts_.options.line ? parts_.options.line->request : "",
      .machine = *machine_,
      .run = run_,
      .clock = parts_.clock,
      .begin_run =
          [this](const report::ActiveRun& run, std::unique_ptr<feed::ProgramFeed> feed) {
            return loop_.begin(run, std::move(feed), {});
          },
      .doubt = StateMark(parts_.line_doubt)});
}

Result<void> Gateway::recover() {
  if (auto fits = check_speed(machine_->capabilities(), parts_.options.speed); !fits) return fits;
  if (!memory_.fault().empty()) {
    run_.last_message = valid_text(memory_.fault(), kMaxReason);
    process::log_error("{}: no program is begun until the memory is discarded at the panel {}",
                       memory_.fault(), run_.label());
  }
  if (line_ && outbox_.active_run()) line_->doubt_text();
  return loop_.recover();
}

void Gateway::receive(const Incoming& incoming, SteadyTime now) {
  std::visit([this, now](const auto& message) { on(message, now); }, incoming);
}

void Gateway::on(const dds::RecordAck& ack, SteadyTime now) {
  server_.on_ack(ack, now);
}

void Gateway::on(const dds::BlockData& data, SteadyTime now) {
  if (run_.session) run_.session->feed().on_data(data, now);
}

void Gateway::on(const ServerSeen& server, SteadyTime) {
  server_.on_server(server.is_connected);
  if (server.is_connected && run_.session) run_.session->feed().ask_again();
}

void Gateway::on(const StopRequested& stop, SteadyTime) {
  process::log_info("stopping on signal {} machine={}", stop.signal, parts_.options.machine);
  stop_requested_ = true;
  (void)stop_without_run("with the gateway");
  loop_.begin_interrupt("the gateway was stopped");
}

bool Gateway::is_at_rest() const {
  return !jogger_.is_active() && !machine_->is_moving() && loop_.may_be_interrupted();
}

/// By a hold or an abort. False: nothing moves without a run.
bool Gateway::stop_without_run(std::string_view why) {
  if (!stop_jog(why) && !stop_homing(why)) return false;
  validity_.note_stopped_motion(parts_.clock.steady_now());
  return true;
}

/// False: no axes are homed.
bool Gateway::stop_homing(std::string_view why) {
  if (run_.session || !machine_->stop_homing()) return false;
  process::log_info("homing stopped {} {}", why, run_.label());
  return true;
}

SteadyTime Gateway::turn(SteadyTime now) {
  server_.announce();
  if (line_ && !stop_requested_) line_->poll(now);
  loop_.step(now);
  jogger_.step(now);
  answer_jog();
  commands_.send();
  // First: a client that learns of a run's end finds the position where the run has left it.
  server_.send_status(now, [this] {
    if (run_.session) run_.session->size_feed(parts_.options.speed.factor);
    return status();
  });
  server_.send_records(now);
  return next_turn(now);
}

SteadyTime Gateway::next_turn(SteadyTime now) const {
  const SteadyTime next_tick = parts_.options.speed.factor ? now + kTick : now;
  if (loop_.is_moving() || jogger_.is_active()) return next_tick;
  if (loop_.is_looking_through()) return now;
  constexpr std::chrono::milliseconds kSoon{20};
  const bool must_send = !server_.is_announced() || !commands_.is_sent();
  SteadyTime next = now + (run_.session || must_send ? report::StatusPublisher::kMinInterval
                                                     : report::StatusPublisher::kMaxInterval);
  if (must_send) next = std::min(next, now + kSoon);
  if (loop_.waits_for_machine()) return next_tick;
  const auto look_at = [&next](const std::optional<SteadyTime>& due) {
    if (due) next = std::min(next, *due);
  };
  look_at(server_.next_poll());
  if (run_.session) look_at(run_.session->feed().next_poll());
  if (line_ && !stop_requested_) look_at(line_->next_poll(now));
  return std::max(next, now + std::chrono::milliseconds(1));
}

dds::Status Gateway::status() const {
  dds::Status status = status_.build({.has_line = line_ != nullptr,
                                      .is_connected = server_.is_connected(),
                                      .line_fault = line_ ? line_->fault() : "",
                                      .refused_by_server = server_.refused()});
  status.switches = panel_.switches();
  status.jog = jogger_.status();
  if (jogger_.is_active()) status.mode = dds::ControllerMode::Manual;
  return status;
}

}  // namespace dripline::gateway
