#include <spdlog/spdlog.h>

#include "gateway/app/gateway.hpp"
#include "protocol/base/one_line.hpp"

/// The part of the gateway that asks the machine's side: the remote enable, cycle start, and what
/// else is done at the machine's own panel.
namespace dripline::gateway {

using dds::CommandAction;
using machine::MachineState;

namespace {

/// A command that came from the panel; it is carried out as one from the network is.
dds::Command command_of(CommandAction action, const PanelCommand& panel) {
  dds::Command command;
  command.action = action;
  command.argument = panel.text;
  command.value = panel.value;
  return command;
}

std::string_view state_text(bool is_on) {
  return is_on ? "on" : "off";
}

}  // namespace

std::optional<Gateway::Reply> Gateway::refusal_without_consent(const dds::Command& command) const {
  const bool releases = command.action == CommandAction::Switch &&
                        command.argument == "emergency_stop" && command.value == 0;
  if (releases && is_stopped_at_panel_)
    return refuse("the emergency stop was pressed at the machine's panel: release it there");
  if (consent_.is_given() || !needs_consent(command, machine_.panel())) return std::nullopt;
  return refuse(std::string(kNoConsent));
}

void Gateway::on_panel(const PanelRequest& request) {
  using Verb = PanelCommand::Verb;
  if (request.command.verb == Verb::Status) return request.answer("ok " + panel_status());
  const Reply reply = carry_out_at_panel(request.command);
  spdlog::info("panel {}{}{} {}", reply.is_accepted ? "accepted" : "refused",
               reply.reason.empty() ? "" : ": ", reply.reason, label());
  // With a run, its records are committed at the end of the block.
  if (!session_) {
    if (const auto done = outbox_.commit(); !done)
      spdlog::error("panel: not on record: {} {}", done.error().what, label());
  }
  publisher_.reset();
  std::string answer = reply.is_accepted ? "ok" : "refused";
  if (!reply.reason.empty()) answer += " " + valid_text(reply.reason, kMaxReason);
  request.answer(std::move(answer));
}

Gateway::Reply Gateway::discard_memory() {
  if (session_) return refuse(fmt::format("run {} is active", session_->run().run));
  memory_.discard();
  last_message_.clear();
  return {};
}

Gateway::Reply Gateway::carry_out_at_panel(const PanelCommand& command) {
  using Verb = PanelCommand::Verb;
  switch (command.verb) {
    case Verb::RemoteEnable:
      return set_remote_enable(command.value == 1);
    case Verb::EmergencyStop:
      return set_emergency_stop_at_panel(command.value == 1);
    case Verb::Switch:
      if (command.text == "emergency_stop") return set_emergency_stop_at_panel(command.value == 1);
      return set_switch(command_of(CommandAction::Switch, command));
    case Verb::FeedOverride:
      return set_override(command_of(CommandAction::FeedOverride, command));
    case Verb::RapidOverride:
      return set_override(command_of(CommandAction::RapidOverride, command));
    case Verb::SpindleOverride:
      return set_override(command_of(CommandAction::SpindleOverride, command));
    case Verb::DiscardMemory:
      return discard_memory();
    default:
      break;
  }
  if (!session_ || is_ending_) return refuse("no run is active");
  switch (command.verb) {
    case Verb::CycleStart:
      recorder_.note_at_panel(machine_.status().origin, "cycle start");
      return cycle_start();
    case Verb::Hold:
      return operate(command_of(CommandAction::Hold, command));
    case Verb::Abort:
      recorder_.note_at_panel(machine_.status().origin, "abort");
      return operate(command_of(CommandAction::Abort, command));
    case Verb::Answer:
      return operate(command_of(CommandAction::Answer, command));
    case Verb::Handwheel:
      return operate(command_of(CommandAction::Handwheel, command));
    default:
      return refuse("not a verb of this panel");
  }
}

/// Giving it moves nothing by itself: a run that waits goes on waiting for a cycle start, from here
/// or, now, from afar.
Gateway::Reply Gateway::set_remote_enable(bool is_enabled) {
  if (consent_.is_unattended())
    return refuse("this machine is unattended (--unattended yes): the network may start it");
  if (is_enabled && machine_.panel().emergency_stop)
    return refuse("the emergency stop is pressed: release it first");
  if (consent_.is_given() == is_enabled) return {};
  consent_.set_enabled(is_enabled);
  spdlog::warn("remote enable {} {}", state_text(is_enabled), label());
  recorder_.note_at_panel(machine_.status().origin,
                          fmt::format("remote enable {}", state_text(is_enabled)));
  return {};
}

/// What was pressed here is released here only.
Gateway::Reply Gateway::set_emergency_stop_at_panel(bool is_pressed) {
  is_stopped_at_panel_ = is_pressed;
  return set_emergency_stop(is_pressed);
}

/// Of a run that waits for it, or after a hold or a stop.
Gateway::Reply Gateway::cycle_start() {
  if (!consent_.is_awaited()) {
    const dds::Command resume = command_of(CommandAction::Resume, {});
    return operate(resume);
  }
  if (machine_.panel().emergency_stop)
    return refuse("the emergency stop is pressed: release it first");
  consent_.end_wait();
  spdlog::info("cycle start {}", label());
  last_step_ = parts_.clock.steady_now();
  (void)machine_.resume();  // of a hold that was asked for meanwhile
  return {};
}

/// True: nobody has begun the run yet. Nothing of it is interpreted, an abort works.
bool Gateway::wait_for_cycle_start(SteadyTime now) {
  if (!consent_.is_awaited()) return false;
  (void)machine_.poll(machine::Seconds{0}, 0);
  commit_reports();
  if (consent_.is_overdue(now)) {
    end_run(dds::RunOutcome::Aborted, fmt::format("no cycle start at the machine within {} s",
                                                  parts_.options.cycle_start_wait.count()));
  } else {
    judge_end();
  }
  return true;
}

dds::RemoteEnable Gateway::remote_enable() const {
  if (consent_.is_unattended()) return dds::RemoteEnable::Unattended;
  return consent_.is_given() ? dds::RemoteEnable::Given : dds::RemoteEnable::NotGiven;
}

dds::WaitsFor Gateway::waits_for(const dds::Status& status) const {
  using dds::WaitsFor;
  if (!recorder_.trouble().empty()) return WaitsFor::Disk;
  if (!session_ || is_ending_ || machine_.panel().emergency_stop) return WaitsFor::Nothing;
  if (consent_.is_awaited()) return WaitsFor::CycleStart;
  switch (machine_.state()) {
    case MachineState::Held:
    case MachineState::ProgramStop:
    case MachineState::OptionalStop:
    case MachineState::SingleBlock:
      return WaitsFor::CycleStart;
    default:
      break;
  }
  if (status.execution != dds::Execution::Waiting) return WaitsFor::Nothing;
  return session_->waits() == RunSession::Waits::ForOperator ? WaitsFor::Answer : WaitsFor::Text;
}

std::string Gateway::panel_status() const {
  const dds::Status now = status();
  return fmt::format("{} remote_enable={} waits_for={} emergency_stop={}{}{}",
                     dds::to_string(now.execution), dds::to_string(now.remote_enable),
                     dds::to_string(now.waits_for), now.emergency_stop ? "pressed" : "released",
                     now.message.empty() ? "" : " message=", one_line(now.message));
}

}  // namespace dripline::gateway
