#include "gateway/app/panel/panel_controller.hpp"
#include "gateway/app/run/run_texts.hpp"
#include "gateway/app/run/start_checks.hpp"
#include "gateway/app/serial/serial_gateway.hpp"
#include "gateway/app/status_builder.hpp"
#include "protocol/process/log.hpp"

/// The commands of a machine on the gateway's own line: those of the server, and what is done at
/// the panel of this gateway.
namespace dripline::gateway {

using dds::CommandAction;

namespace {

constexpr std::string_view kEmergencyStopReason = "EMERGENCY STOP";
constexpr std::string_view kAbortedAtPanel = "aborted at the machine's panel";
constexpr std::string_view kHasOwnPanel =
    "a control on a line has a panel of its own: it takes start, hold, resume and abort";

Reply reply_of(const Result<void>& done) {
  return done ? Reply{} : refuse(done.error().what);
}

}  // namespace

void SerialGateway::on(const dds::Command& command, SteadyTime) {
  if (command.action == CommandAction::Refuse) return server_.on_refusal(command);
  const bool is_stop = dds::is_stop(command.action, command.argument, command.value);
  if (!is_stop && command.session != 0 && command.session != parts_.session) {
    process::log_warning("command {} is for another gateway of this name {}", command.id, label());
    return;
  }
  const auto known = commands_.find(command.id);
  if (!known) {
    process::log_error("command {} cannot be looked up: {} {}", command.id, known.error().what,
                       label());
    if (!is_stop) return;  // its sender tries again
  }
  if (known && *known) return commands_.answer(command.id, **known);
  const Reply reply = carry_out(command, is_stop);
  process::log_info("command {} {} {}{}{} {}", command.id, dds::to_string(command.action),
                    reply.is_accepted ? "accepted" : "refused", reply.reason.empty() ? "" : ": ",
                    reply.reason, label());
  const bool is_kept = command.action == CommandAction::Start && reply.is_accepted;
  if (!is_kept) {
    commands_.stage(command.id, reply);
    if (records_.fault().empty()) (void)records_.commit();
  }
  commands_.answer(command.id, reply);
}

Reply SerialGateway::carry_out(const dds::Command& command, bool is_stop) {
  if (is_stop) {
    validity_.note_stop(command);
  } else if (auto refusal = validity_.refusal(command, parts_.clock.steady_now())) {
    return refuse(*std::move(refusal));
  }
  if (stop_requested_ && !is_stop) return refuse(std::string(kIsStopping));
  if (command.action == CommandAction::Start) return start(command);
  machine::OperatorPanel panel;
  panel.emergency_stop = emergency_stop_.is_pressed();
  if (!consent_.is_given() && needs_consent(command, panel)) return refuse(std::string(kNoConsent));
  if (command.action == CommandAction::Switch && command.argument == "emergency_stop")
    return set_emergency_stop(command.value == 1, false);
  if (command.action == CommandAction::Jog || command.argument == dds::kJogAbort)
    return refuse(std::string(kHasOwnPanel));
  const bool has_run = run_.is_active() && !run_.is_ending();
  if (!has_run && stop_requested_ && is_stop) return {true, std::string(kHasStopped)};
  if (!has_run) return refuse("no run is active");
  if (!command.run.empty() && command.run != run_.run().run)
    return refuse(fmt::format("run {} is not active, {} is", command.run, run_.run().run));
  return operate(command);
}

Reply SerialGateway::start(const dds::Command& command) {
  if (auto known = commands_.find_start(command.run)) return *known;
  if (command.run.empty() || command.run.size() > report::RunJournal::kMaxRun)
    return refuse("a start needs a run of 1 to 40 bytes");
  if (run_.is_active())
    return refuse(
        fmt::format("busy with run {} of program {}", run_.run().run, run_.run().program));
  if (auto refusal = refusal_of_program(command, parts_.options)) return *refusal;
  if (emergency_stop_.is_pressed()) return refuse(std::string(kEmergencyStopIsPressed));
  return reply_of(run_.start(command, parts_.clock.steady_now()));
}

Reply SerialGateway::operate(const dds::Command& command) {
  switch (command.action) {
    case CommandAction::Hold:
      return reply_of(run_.hold());
    case CommandAction::Resume:
      if (emergency_stop_.is_pressed()) return refuse(std::string(kEmergencyStopIsPressed));
      return reply_of(run_.resume());
    case CommandAction::Abort:
      run_.abort("aborted by command");
      return {};
    default:
      return refuse(std::string(kHasOwnPanel));
  }
}

/// It ends the text; the machine's own circuit stops the machine.
Reply SerialGateway::set_emergency_stop(bool is_pressed, bool is_at_panel) {
  if (!is_pressed && emergency_stop_.is_pressed_at_panel() && !is_at_panel)
    return refuse("the emergency stop was pressed at the machine: it is released there");
  server_.want_status();
  if (!is_pressed) return {true, answer_of_release(emergency_stop_.release())};
  if (!emergency_stop_.is_pressed())
    records_.append({.kind = dds::RecordKind::Stop,
                     .run = run_.is_active() ? run_.run().run : std::string(),
                     .text = "emergency stop"});
  consent_.set_enabled(false);  // after the stop the network may start nothing
  run_.abort(std::string(kEmergencyStopReason));
  end_transfer(std::string(kEmergencyStopReason));
  return {true, answer_of_press(emergency_stop_.press(is_at_panel))};
}

void SerialGateway::on(const PanelRequest& request, SteadyTime) {
  if (request.command.verb == PanelCommand::Verb::Status)
    return request.answer("ok " + panel_status(status()));
  if (const auto late = refusal_of_late(request)) {
    process::log_warning("panel refused: {} {}", *late, label());
    return request.answer("refused " + *late);
  }
  validity_.note_panel(parts_.clock.steady_now());
  const Reply reply = carry_out(request.command);
  process::log_info("panel {}{}{} {}", reply.is_accepted ? "accepted" : "refused",
                    reply.reason.empty() ? "" : ": ", reply.reason, label());
  if (records_.fault().empty()) (void)records_.commit();
  server_.want_status();
  std::string answer = reply.is_accepted ? "ok" : "refused";
  if (!reply.reason.empty()) answer += " " + valid_text(reply.reason, kMaxReason);
  request.answer(std::move(answer));
}

Reply SerialGateway::carry_out(const PanelCommand& command) {
  using Verb = PanelCommand::Verb;
  switch (command.verb) {
    case Verb::RemoteEnable:
      return set_remote_enable(command.value == 1);
    case Verb::EmergencyStop:
      return set_emergency_stop(command.value == 1, true);
    case Verb::Switch:
      if (command.text == "emergency_stop") return set_emergency_stop(command.value == 1, true);
      return refuse(std::string(kHasOwnPanel));
    case Verb::CycleStart:
    case Verb::Hold:
    case Verb::Abort:
      break;
    default:
      return refuse(std::string(kHasOwnPanel));
  }
  const bool has_run = run_.is_active() && !run_.is_ending();
  if (!has_run && command.verb == Verb::Abort && end_transfer(std::string(kAbortedAtPanel)))
    return {};
  const bool is_stop = command.verb == Verb::Hold || command.verb == Verb::Abort;
  if (!has_run && stop_requested_ && is_stop) return {true, std::string(kHasStopped)};
  if (!has_run) return refuse("no run is active");
  if (stop_requested_ && !is_stop) return refuse(std::string(kIsStopping));
  if (command.verb == Verb::Hold) return reply_of(run_.hold());
  if (command.verb == Verb::Abort) {
    note_at_panel("abort");
    run_.abort(std::string(kAbortedAtPanel));
    return {};
  }
  if (emergency_stop_.is_pressed()) return refuse(std::string(kEmergencyStopIsPressed));
  note_at_panel("cycle start");
  return reply_of(run_.cycle_start());
}

/// Moves nothing by itself: a run that waits continues to wait for a cycle start, at the panel or,
/// now, over the network.
Reply SerialGateway::set_remote_enable(bool is_enabled) {
  if (consent_.is_unattended())
    return refuse("this machine is unattended (--unattended yes): the network may start it");
  if (is_enabled && stop_requested_) return refuse(std::string(kIsStopping));
  if (is_enabled && emergency_stop_.is_pressed())
    return refuse(std::string(kEmergencyStopIsPressed));
  if (consent_.is_given() == is_enabled) return {};
  consent_.set_enabled(is_enabled);
  note_at_panel(fmt::format("remote enable {}", is_enabled ? "on" : "off"));
  return {};
}

/// Whether programs may be sent without a run. A control that is not in the mode to store them
/// executes them, so this needs the same consent as a run.
Result<void> SerialGateway::check_transfer() const {
  if (auto allowed = check_stop(); !allowed) return allowed;
  if (!run_.must_wait_for_panel()) return {};
  if (!is_begun_at_control(settings_)) {
    return fail(Errc::Conflict,
                "people may be at this machine, and its control does not ask for programs: give "
                "the remote enable at its panel (dncgw panel --machine {} remote-enable on)",
                parts_.options.machine);
  }
  return fail(Errc::Conflict,
              "the control has asked before this, which is no consent to it: stop that at the "
              "control, and ask again when it is sent; or give the remote enable (dncgw panel "
              "--machine {} remote-enable on)",
              parts_.options.machine);
}

/// Whether anything may be sent to the control.
Result<void> SerialGateway::check_stop() const {
  if (!emergency_stop_.is_pressed()) return {};
  return fail(Errc::Conflict, "{}", kEmergencyStopIsPressed);
}

/// Whatever it is: programs without a run, an answer, and what has not reached the line yet. False:
/// nothing was seen to be sent.
bool SerialGateway::end_transfer(const std::string& reason) {
  const bool is_sending = port_->progress().has_value();
  port_->abort_any(reason, [](const Result<void>&) {});
  return is_sending;
}

/// What the control has asked for gets nothing, now and later: it asks again.
void SerialGateway::drop_request(const std::string& reason) {
  calls_.clear();
  const auto request = port_->view().request;
  if (!request || !request->answer.empty()) return;
  port_->note("refused: " + reason);
  port_->refuse(reason);
}

void SerialGateway::note_at_panel(const std::string& text) {
  records_.append({.kind = dds::RecordKind::Message,
                   .run = run_.is_active() ? run_.run().run : std::string(),
                   .text = "at the machine's panel: " + text});
}

}  // namespace dripline::gateway
