#include "gateway/app/panel/consent.hpp"

#include "protocol/dds/endpoint.hpp"

namespace dripline::gateway {
namespace {

/// Switching these off lets a machine continue where it would have stopped.
bool lets_run_on(const dds::Command& command, const machine::OperatorPanel& panel) {
  // These change what is executed, or how fast, up and down.
  if (command.argument.starts_with("block_skip") || command.argument == "dry_run") return true;
  if (command.value != 0) return false;
  if (command.argument == "machine_lock") return panel.machine_lock;
  if (command.argument == "test_run") return panel.test_run;
  if (command.argument == "emergency_stop") return panel.emergency_stop;
  if (command.argument == "single_block") return panel.single_block;
  if (command.argument == "optional_stop") return panel.optional_stop;
  if (command.argument == "handwheel") return panel.handwheel;
  return false;
}

}  // namespace

bool needs_consent(const dds::Command& command, const machine::OperatorPanel& panel) {
  using dds::CommandAction;
  switch (command.action) {
    case CommandAction::Start:
    case CommandAction::Hold:
    case CommandAction::Abort:
    case CommandAction::Refuse:  // these three are no commands to the machine
    case CommandAction::Query:
    case CommandAction::Playback:
      return false;
    case CommandAction::Switch:
      return lets_run_on(command, panel);
    case CommandAction::FeedOverride:
    case CommandAction::RapidOverride:
    case CommandAction::SpindleOverride:
      return !(command.value <= dds::override_of(command.action, panel));
    case CommandAction::SetPosition:  // the next program cuts elsewhere
    case CommandAction::Resume:
    case CommandAction::Answer:
    case CommandAction::Handwheel:
    case CommandAction::Jog:
      break;
  }
  return true;
}

}  // namespace dripline::gateway
