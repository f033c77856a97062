#include "gateway/app/serial/serial_gateway.hpp"

#include <algorithm>
#include <utility>

#include "gateway/app/serial/serial_status.hpp"
#include "gateway/line/port_transfer.hpp"
#include "protocol/process/log.hpp"

namespace dripline::gateway {
namespace {

constexpr std::string_view kRecordDevice = "line";

}  // namespace

SerialGateway::SerialGateway(Parts parts)
    : parts_(std::move(parts)),
      settings_(parts_.options.line->settings),
      server_({.options = parts_.options,
               .endpoint = parts_.endpoint,
               .outbox = parts_.outbox,
               .session = parts_.session}),
      consent_(parts_.options.is_unattended),
      validity_(parts_.session),
      commands_(parts_.options.machine, parts_.outbox, parts_.endpoint),
      records_({.machine = parts_.options.machine, .outbox = parts_.outbox, .clock = parts_.clock}),
      run_({.options = parts_.options,
            .settings = settings_,
            .session = parts_.session,
            .endpoint = parts_.endpoint,
            .outbox = parts_.outbox,
            .journal = parts_.journal,
            .records = records_,
            .commands = commands_,
            .consent = consent_,
            .clock = parts_.clock}),
      calls_(parts_.rules->reply()),
      inbound_({.control = parts_.options.control,
                .device = std::string(kRecordDevice),
                .rules = parts_.rules,
                .settings = settings_,
                .records = records_,
                .uploads = parts_.uploads,
                .clock = parts_.clock,
                .run = [this] { return run_.last_run(); },
                .check_allowed = [this] { return check_stop(); },
                .on_request = [this](line::RuleAction action,
                                     const std::string& argument) { add_call(action, argument); }}),
      transfer_({.clock = parts_.clock, .check_allowed = [this] { return check_transfer(); }}),
      answers_({.session = parts_.session,
                .endpoint = parts_.endpoint,
                .uploads = parts_.uploads,
                .inbound = inbound_,
                .calls = calls_,
                .transfer = transfer_,
                .rules = parts_.rules,
                .extracts_programs = settings_.extracts_programs}),
      kept_transfer_(parts_.kept_transfer),
      emergency_stop_(parts_.kept_emergency_stop),
      tasks_(std::make_shared<TaskQueue>(parts_.wake)) {}

SerialGateway::~SerialGateway() {
  tasks_->close();
  if (port_) port_->close("the gateway stopped");
}

std::shared_ptr<line::PortLine> SerialGateway::make_line(line::LineMemory before) {
  const auto& options = parts_.options;
  before.may_be_in_text = before.may_be_in_text || run_.is_program_broken();
  return line::PortLine::make(
      {.names = {options.machine, options.machine, options.line->address},
       .settings = settings_,
       .clock = parts_.clock,
       .post = [tasks = tasks_](line::Task task) { tasks->post(std::move(task)); },
       .open = parts_.open,
       .recording = {.port = options.machine, .folder = parts_.recordings},
       .on_traffic = [](const line::PortTraffic&) {},
       .listener = listener(),
       .before = std::move(before),
       .keep = [this](const line::LineMemory& memory) { return kept_transfer_.write(memory); }});
}

line::PortListener SerialGateway::listener() {
  return {.on_incoming =
              [this](const line::Incoming& incoming, std::function<void()> kept) {
                inbound_.take(incoming, std::move(kept));
              },
          .on_sent = [this](const line::SendEnd& end) { on_sent(end); },
          .on_request = [this](const wire::TransferRequest& request) { on_request(request); },
          .on_change = [this] { server_.want_status(); },
          .on_progress = [this](const line::SendProgress& now) { run_.on_progress(now); }};
}

void SerialGateway::on_sent(const line::SendEnd& end) {
  if (end.progress.kind == line::JobKind::Transfer) port_->note(line::transfer_words(end));
  run_.on_sent(end);
  server_.want_status();
}

/// The line is opened when the former run has its end: so the first request is not taken for one.
Result<void> SerialGateway::recover() {
  if (parts_.options.speed.factor != 1)
    return fail(Errc::Unsupported, "a control on a line moves in real time: its speed is 1x");
  auto done = run_.recover();
  auto before = kept_transfer_.read();
  if (!before) return fail(before.error());
  port_ = make_line(*std::move(before));
  run_.use(*port_);
  inbound_.use(*port_);
  transfer_.use(*port_);
  answers_.use(port_);
  port_->open();
  return done;
}

std::string SerialGateway::label() const {
  if (!run_.is_active()) return fmt::format("machine={}", parts_.options.machine);
  return fmt::format("machine={} run={}", parts_.options.machine, run_.run().run);
}

void SerialGateway::receive(const Incoming& incoming, SteadyTime now) {
  std::visit([this, now](const auto& message) { on(message, now); }, incoming);
}

void SerialGateway::on(const dds::RecordAck& ack, SteadyTime now) {
  server_.on_ack(ack, now);
}

void SerialGateway::on(const dds::BlockData& data, SteadyTime now) {
  run_.on_data(data, now);
}

void SerialGateway::on(const ServerSeen& server, SteadyTime) {
  server_.on_server(server.is_connected);
  if (server.is_connected) run_.ask_again();
}

void SerialGateway::on(const dds::LineRequest& request, SteadyTime) {
  answers_.take(request, run_.is_active());
  server_.want_status();
}

void SerialGateway::add_call(line::RuleAction action, const std::string& argument) {
  using dds::LineCallAction;
  port_->note(fmt::format("requested at the control: {} {}", to_string(action), argument));
  const auto asked = action == line::RuleAction::Send        ? LineCallAction::Send
                     : action == line::RuleAction::Directory ? LineCallAction::Directory
                     : action == line::RuleAction::NextJob   ? LineCallAction::NextJob
                                                             : LineCallAction::Restart;
  calls_.add(asked, argument, parts_.clock.steady_now());
  server_.want_status();
}

/// A program that the control is about to send is taken; what it asks for waits for the server's
/// word, or for a run.
void SerialGateway::on_request(const wire::TransferRequest& request) {
  using Kind = wire::TransferRequest::Kind;
  if (request.kind == Kind::TakeProgram) return port_->accept_receive(request.name);
  const bool is_list = request.kind == Kind::Directory;
  calls_.add(is_list ? dds::LineCallAction::List : dds::LineCallAction::Program, request.name,
             parts_.clock.steady_now());
  server_.want_status();
}

void SerialGateway::on(const StopRequested& stop, SteadyTime) {
  process::log_info("stopping on signal {} machine={}", stop.signal, parts_.options.machine);
  stop_requested_ = true;
}

SteadyTime SerialGateway::turn(SteadyTime now) {
  server_.announce();
  tasks_->run();
  if (now >= next_tick_) {
    next_tick_ = now + kTick;
    port_->tick();
  }
  run_.poll(now);
  if (run_.is_on_line() || is_sending_programs()) calls_.clear();
  calls_.poll(now);
  records_.poll(now);
  tasks_->run();
  if (const auto allowed = check_stop(); !allowed) drop_request(allowed.error().what);
  commands_.send();
  server_.send_records(now);
  server_.send_status(now, [this] { return status(); });
  constexpr std::chrono::milliseconds kSoon{20};
  SteadyTime next = next_tick_;
  if (!server_.is_announced() || !commands_.is_sent()) next = std::min(next, now + kSoon);
  if (run_.is_active()) next = std::min(next, now + report::StatusPublisher::kMinInterval);
  if (run_.is_looking()) next = std::min(next, now + std::chrono::milliseconds(5));
  for (const auto& due : {server_.next_poll(), run_.next_poll()}) {
    if (due) next = std::min(next, *due);
  }
  return std::max(next, now + std::chrono::milliseconds(1));
}

bool SerialGateway::is_sending_programs() const {
  const auto now = port_->progress();
  return now && now->kind == line::JobKind::Transfer;
}

/// In the middle of a program the line is closed, so that nothing more of it leaves.
Result<void> SerialGateway::interrupt_run(const std::string& reason) {
  if (port_) port_->close(reason);
  tasks_->run();
  run_.interrupt(reason);
  if (!run_.is_active()) return {};
  return fail(Errc::Io, "{}", records_.fault());
}

dds::Status SerialGateway::status() const {
  SerialState state{.options = parts_.options,
                    .session = parts_.session,
                    .clock = parts_.clock,
                    .outbox = parts_.outbox,
                    .records = records_,
                    .run = run_,
                    .consent = consent_,
                    .server = server_,
                    .uploads = parts_.uploads,
                    .calls = calls_,
                    .is_emergency_stopped = emergency_stop_.is_pressed(),
                    .buffered_bytes = run_.buffered_bytes(),
                    .has_all_text = run_.has_all_text()};
  state.buffered_seconds = run_.seconds_of(state.buffered_bytes);
  if (port_) {
    state.view = port_->view();
    state.progress = port_->progress();
    state.recorded = port_->recorder().next_number();
  }
  return make_status(state);
}

}  // namespace dripline::gateway
