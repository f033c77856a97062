#include <utility>

#include "gateway/app/gateway.hpp"
#include "protocol/dds/endpoint.hpp"
#include "protocol/process/log.hpp"

/// What is done at the machine's own panel.
namespace dripline::gateway {

using dds::CommandAction;

namespace {

constexpr const char* kNotOnRecord = "done, but not on record yet: the records cannot be written";

/// What is done at the panel is carried out as a command from the network is.
dds::Command command_of(const PanelCommand& panel) {
  using Verb = PanelCommand::Verb;
  constexpr std::pair<Verb, CommandAction> kActions[] = {
      {Verb::Switch, CommandAction::Switch},
      {Verb::FeedOverride, CommandAction::FeedOverride},
      {Verb::RapidOverride, CommandAction::RapidOverride},
      {Verb::SpindleOverride, CommandAction::SpindleOverride},
      {Verb::Hold, CommandAction::Hold},
      {Verb::Abort, CommandAction::Abort},
      {Verb::Answer, CommandAction::Answer},
      {Verb::Handwheel, CommandAction::Handwheel}};
  dds::Command command;
  for (const auto& [verb, action] : kActions) {
    if (verb == panel.verb) command.action = action;
  }
  command.argument = panel.text;
  command.value = panel.value;
  return command;
}

}  // namespace

void Gateway::on(const PanelRequest& request, SteadyTime) {
  if (request.command.verb == PanelCommand::Verb::Status)
    return request.answer("ok " + panel_status(status()));
  if (const auto late = refusal_of_late(request)) {
    process::log_warning("panel refused: {} {}", *late, run_.label());
    return request.answer("refused " + *late);
  }
  validity_.note_panel(parts_.clock.steady_now());
  Reply reply = carry_out(request.command);
  process::log_info("panel {}{}{} {}", reply.is_accepted ? "accepted" : "refused",
                    reply.reason.empty() ? "" : ": ", reply.reason, run_.label());
  // With a run, its records are committed at the end of the block.
  if (!run_.session) {
    if (const auto done = outbox_.commit(); !done) {
      process::log_error("panel: not on record yet: {} {}", done.error().what, run_.label());
      if (reply.is_accepted && reply.reason.empty()) reply.reason = kNotOnRecord;
    }
  }
  server_.want_status();
  std::string answer = reply.is_accepted ? "ok" : "refused";
  if (!reply.reason.empty()) answer += " " + valid_text(reply.reason, kMaxReason);
  request.answer(std::move(answer));
}

Reply Gateway::carry_out(const PanelCommand& command) {
  using Verb = PanelCommand::Verb;
  const bool is_switch = command.verb == Verb::EmergencyStop || command.text == "emergency_stop";
  if (stop_requested_ && !is_switch && !gateway::is_stop(command))
    return refuse(std::string(kIsStopping));
  switch (command.verb) {
    case Verb::RemoteEnable:
      if (command.value == 0) (void)stop_jog("without the remote enable");
      return panel_.set_remote_enable(command.value == 1);
    case Verb::EmergencyStop:
      return panel_.set_emergency_stop(command.value == 1, true);
    case Verb::Switch:
      if (command.text == "emergency_stop")
        return panel_.set_emergency_stop(command.value == 1, true);
      return panel_.set_switch(command_of(command));
    case Verb::FeedOverride:
    case Verb::RapidOverride:
    case Verb::SpindleOverride:
      return panel_.set_override(command_of(command));
    case Verb::Home:
    case Verb::Unlock:
      return reference_axes(command.verb == Verb::Home);
    case Verb::Rewind:
      return rewind_tape();
    case Verb::DiscardMemory:
      return discard_memory();
    default:
      break;
  }
  const bool is_stop = command.verb == Verb::Hold || command.verb == Verb::Abort;
  if (is_stop && stop_without_run("at the machine's panel")) return {};
  if (command.verb == Verb::CycleStart && !run_.session && line_ && line_->reset()) {
    recorder_.note_at_panel(machine_->status().origin, "cycle start");
    return {true, "the next text of the line begins a run"};
  }
  if (!run_.is_active() && stop_requested_ && is_stop) return stop_at_end();
  if (!run_.is_active()) return refuse("no run is active");
  switch (command.verb) {
    case Verb::CycleStart:
      recorder_.note_at_panel(machine_->status().origin, "cycle start");
      return cycle_start();
    case Verb::Abort:
      recorder_.note_at_panel(machine_->status().origin, "abort");
      return operate(command_of(command));
    case Verb::Hold:
    case Verb::Answer:
    case Verb::Handwheel:
      return operate(command_of(command));
    default:
      return refuse("not a verb of this panel");
  }
}

/// For a run that waits for it, or after a hold or a stop.
Reply Gateway::cycle_start() {
  if (!consent_.is_awaited()) return resume();
  if (machine_->panel().emergency_stop) return refuse(std::string(kEmergencyStopIsPressed));
  if (loop_.is_rebuilding()) return refuse(std::string(kIsRebuilding));
  if (loop_.is_checking()) return refuse(std::string(kIsChecking));
  if (auto refusal = refusal_of_fault()) return *refusal;
  loop_.cycle_start();
  return {};
}

/// Only at the machine: the person who moves its axes must see them.
Reply Gateway::reference_axes(bool is_homing) {
  if (run_.session) return refuse(fmt::format("run {} is active", run_.session->run().run));
  if (jogger_.is_active()) return refuse(std::string(kIsJogging));
  if (machine_->panel().emergency_stop) return refuse(std::string(kEmergencyStopIsPressed));
  const auto done = is_homing ? machine_->home() : machine_->unlock();
  if (!done) return refuse(done.error().what);
  recorder_.note_at_panel(machine_->status().origin, is_homing ? "home" : "unlock");
  return {};
}

/// On disk with the next program that begins, as the memory that is discarded.
Reply Gateway::rewind_tape() {
  if (run_.session) return refuse(fmt::format("run {} is active", run_.session->run().run));
  memory_.set_tape("", 1);
  memory_.stage();
  run_.last_message.clear();
  return {};
}

Reply Gateway::discard_memory() {
  if (run_.session) return refuse(fmt::format("run {} is active", run_.session->run().run));
  memory_.discard();
  run_.frame_at_rest = setup_shown_ ? positions_.frame_at_start(*setup_shown_) : std::nullopt;
  run_.last_message.clear();
  return {};
}

/// How far the interrupted run has come is not known yet: only a stop may change anything.
void Gateway::serve_stops() {
  using Verb = PanelCommand::Verb;
  for (const PanelRequest& request : parts_.take_panel()) {
    const Verb verb = request.command.verb;
    if (verb == Verb::Hold || verb == Verb::Abort) {  // there is no run to hold
      machine_->abort();
      process::log_warning("panel: the device is stopped while the gateway recovers {}",
                           run_.label());
      request.answer("ok what the machine still had of the interrupted run is ended");
    } else if (is_stop(request.command)) {
      on(request, parts_.clock.steady_now());
    } else {
      request.answer("refused the gateway waits to see where the axes rest: again in some seconds");
    }
  }
}

}  // namespace dripline::gateway
