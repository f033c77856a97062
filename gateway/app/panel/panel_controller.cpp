#include "gateway/app/panel/panel_controller.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/dds/endpoint.hpp"
#include "protocol/process/log.hpp"

namespace dripline::gateway {

using dds::CommandAction;
using machine::OperatorPanel;

namespace {

constexpr double kNoise = 1e-6;
constexpr double kMaxClicks = 1000;  ///< in one command
/// For a control whose setup has no table.
constexpr double kMinSpindle = 0.5, kMaxSpindle = 1.2;

std::string range_of(CommandAction override) {
  if (override == CommandAction::FeedOverride)
    return fmt::format("0 to {:.4g} %", OperatorPanel::kMaxFeedOverride * 100);
  if (override == CommandAction::RapidOverride)
    return fmt::format("0 to {:.4g} %", OperatorPanel::kMaxRapidOverride * 100);
  return fmt::format("{:.4g} to {:.4g} %", kMinSpindle * 100, kMaxSpindle * 100);
}

bool has_override(const machine::MotionCapabilities& machine, CommandAction override) {
  if (override == CommandAction::FeedOverride) return machine.feed_override;
  if (override == CommandAction::RapidOverride) return machine.rapid_override;
  return machine.spindle_override;
}

/// The position of a switch for `factor`; the table's size when there is none.
std::size_t position_of(const std::vector<double>& table, double factor) {
  const auto found = std::find_if(table.begin(), table.end(), [factor](double entry) {
    return std::fabs(entry - factor) <= kNoise;
  });
  return static_cast<std::size_t>(found - table.begin());
}

std::optional<std::string> refusal_of(const std::vector<double>& table, double factor) {
  if (position_of(table, factor) < table.size()) return std::nullopt;
  std::string positions;
  for (const double entry : table) positions += fmt::format(" {:.4g}", entry * 100);
  return fmt::format("{:.4g} %: this control's switch has the positions{} %", factor * 100,
                     positions);
}

constexpr std::string_view kBlockSkip = "block_skip";

/// The level of "block_skip" (1) and "block_skip_2" to "block_skip_9"; 0: another name.
int skip_level_of(std::string_view name) {
  if (!name.starts_with(kBlockSkip)) return 0;
  name.remove_prefix(kBlockSkip.size());
  if (name.empty()) return 1;
  const bool is_level = name.size() == 2 && name[0] == '_' && name[1] >= '2' && name[1] <= '9';
  return is_level ? name[1] - '0' : 0;
}

dds::SwitchState state_of(bool exists, bool is_on) {
  if (!exists) return dds::SwitchState::Unknown;
  return is_on ? dds::SwitchState::On : dds::SwitchState::Off;
}

}  // namespace

/// A setup that is not good here is refused by the next start.
void PanelController::take_tables(const interpreter::Setup& setup) {
  if (parts_.dialect.panel_tables == nullptr) return;
  auto tables = parts_.dialect.panel_tables(setup);
  if (tables) {
    tables_ = *std::move(tables);
  } else {
    process::log_warning("setup: {} {}", tables.error().what, parts_.run.label());
  }
}

void PanelController::begin(const interpreter::Setup& setup) {
  take_tables(setup);
  OperatorPanel panel;
  panel.emergency_stop = parts_.emergency_stop.is_pressed();
  panel.single_block = setup.switches.single_block;
  panel.optional_stop = setup.switches.optional_stop;
  panel.block_skip = setup.switches.block_skip;
  panel.dry_run = setup.switches.dry_run && tables_.dry_run;
  if (tables_.dry_run) {
    panel.dry_run_speed = tables_.dry_run->feed.mm() / 60;
    panel.dry_run_spindle = tables_.dry_run->turns_spindle;
  }
  parts_.machine.set_panel(panel);
}

std::uint16_t PanelController::skip_levels() const {
  const OperatorPanel& panel = parts_.machine.panel();
  const unsigned first = panel.block_skip ? 1u << 1 : 0u;
  return panel.skip_levels.value_or(static_cast<std::uint16_t>(tables_.skip_levels | first));
}

dds::PanelSwitches PanelController::switches() const {
  const interpreter::SwitchRules& rules = parts_.dialect.switches;
  const machine::MotionCapabilities& machine = parts_.machine.capabilities();
  const OperatorPanel& panel = parts_.machine.panel();
  dds::PanelSwitches shown;
  shown.optional_stop = state_of(rules.optional_stop, panel.optional_stop);
  const unsigned levels = skip_levels();
  shown.block_skip = state_of(rules.block_skip, (levels >> 1 & 1u) != 0);
  for (int level = 2; level <= rules.skip_levels; ++level) {
    if ((levels >> level & 1u) == 0) continue;
    shown.skip_levels += fmt::format("{}{}", shown.skip_levels.empty() ? "" : ",", level);
  }
  shown.dry_run = state_of(tables_.dry_run.has_value(), panel.dry_run);
  shown.machine_lock = state_of(rules.machine_lock && machine.places_axes, panel.machine_lock);
  shown.test_run = state_of(true, panel.test_run);
  shown.handwheel = state_of(machine.handwheel && !tables_.click_seconds.empty(), panel.handwheel);
  return shown;
}

std::string PanelController::known_switches() const {
  const dds::PanelSwitches has = switches();
  std::string names = parts_.machine.capabilities().single_block ? "single_block, " : "";
  const auto add = [&names](std::string_view name, dds::SwitchState state) {
    if (state != dds::SwitchState::Unknown) names += fmt::format("{}, ", name);
  };
  add("optional_stop", has.optional_stop);
  add(kBlockSkip, has.block_skip);
  const int levels = parts_.dialect.switches.skip_levels;
  if (levels > 1) names += fmt::format("block_skip_2 to block_skip_{}, ", levels);
  add("dry_run", has.dry_run);
  add("machine_lock", has.machine_lock);
  add("test_run", has.test_run);
  add("handwheel", has.handwheel);
  return names + "emergency_stop";
}

Reply PanelController::set_switch(const dds::Command& command) {
  const std::string& name = command.argument;
  if (command.value != 0 && command.value != 1)
    return refuse(fmt::format("a switch is 0 or 1, not {}", command.value));
  const bool is_on = command.value == 1;
  if (name == "emergency_stop") return set_emergency_stop(is_on, false);
  const machine::MotionCapabilities& machine = parts_.machine.capabilities();
  OperatorPanel panel = parts_.machine.panel();
  if (name == "single_block" && machine.single_block) {
    panel.single_block = is_on;
    parts_.machine.set_panel(panel);
    return {};
  }
  if (name == "optional_stop" && parts_.dialect.switches.optional_stop) {
    panel.optional_stop = is_on;
    parts_.machine.set_panel(panel);
    return note(name, is_on, "");
  }
  if (const int level = skip_level_of(name); level > 0 && parts_.dialect.switches.block_skip &&
                                             level <= parts_.dialect.switches.skip_levels)
    return set_block_skip(level, is_on);
  if (name == "dry_run") return set_dry_run(is_on);
  if (name == "machine_lock" && parts_.dialect.switches.machine_lock)
    return set_machine_lock(is_on);
  if (name == "test_run") return set_between_runs("test run", &OperatorPanel::test_run, is_on);
  if (name == "handwheel" && machine.handwheel) {
    if (tables_.click_seconds.empty())
      return refuse(
          fmt::format("a handwheel drives no program of control {}", parts_.dialect.name));
    panel.handwheel = is_on;
    parts_.machine.set_panel(panel);
    return {};
  }
  if (name == "single_block" || name == "handwheel")
    return refuse(fmt::format("this machine has no {}", name));
  return refuse(fmt::format("no switch '{}': {}", name, known_switches()));
}

/// What changes how a run's program is executed is on its record, with the block.
Reply PanelController::note(const std::string& name, bool is_on, const std::string& effect) {
  if (!parts_.run.is_active()) return {true, effect};
  parts_.recorder.note(parts_.machine.status().origin,
                       fmt::format("switch {} {}{}{}", name, is_on ? "on" : "off",
                                   effect.empty() ? "" : ": ", effect));
  return {true, effect};
}

/// What was read ahead was read with the switch as it was: a control does not skip what it has in
/// its buffer.
Reply PanelController::set_block_skip(int level, bool is_on) {
  RunSession* const session = parts_.run.is_active() ? parts_.run.session.get() : nullptr;
  if (session != nullptr && (session->is_rebuilding() || session->check() != nullptr))
    return refuse("the program is looked through with the switch as it is: set it after that");
  OperatorPanel panel = parts_.machine.panel();
  const unsigned bit = 1u << level;
  const unsigned levels = is_on ? skip_levels() | bit : skip_levels() & ~bit;
  if (parts_.dialect.switches.skip_levels > 1)
    panel.skip_levels = static_cast<std::uint16_t>(levels);
  panel.block_skip = (levels & 2u) != 0;
  parts_.machine.set_panel(panel);
  if (session == nullptr) return {};
  const std::string name = level == 1 ? "block_skip" : fmt::format("block_skip_{}", level);
  const auto last = session->set_block_skip(static_cast<std::uint16_t>(levels));
  if (!last)
    return note(name, is_on, "the program is read to its end: takes effect at the next start");
  session->note_skip_change(fmt::format("switch {} {}", name, is_on ? "on" : "off"), *last,
                            panel.block_skip);
  return note(name, is_on,
              *last == 0 ? std::string("from the first block on")
                         : fmt::format("takes effect after block {}, which was read last", *last));
}

Reply PanelController::set_dry_run(bool is_on) {
  if (!tables_.dry_run) {
    const bool may_have = parts_.dialect.panel_tables != nullptr;
    return refuse(may_have ? "no dry run: [control] dry_run_feed of the setup gives the panel one"
                           : fmt::format("control {} has no dry run", parts_.dialect.name));
  }
  const machine::MachineState state = parts_.machine.state();
  const bool is_running = parts_.run.is_active() && !parts_.consent.is_awaited() &&
                          (parts_.machine.is_moving() || state == machine::MachineState::Running ||
                           state == machine::MachineState::Idle);
  if (parts_.dialect.switches.dry_run_at_rest && is_running)
    return refuse("dry run is changed only while the program is halted: hold it first");
  OperatorPanel panel = parts_.machine.panel();
  panel.dry_run = is_on;
  panel.dry_run_speed = tables_.dry_run->feed.mm() / 60;
  panel.dry_run_spindle = tables_.dry_run->turns_spindle;
  parts_.machine.set_panel(panel);
  if (parts_.machine.capabilities().dry_run) return note("dry_run", is_on, "");
  return note("dry_run", is_on, parts_.run.is_active() ? "takes effect at the next start" : "");
}

/// Only a machine whose axes can be placed is where it was when the lock is released.
Reply PanelController::set_machine_lock(bool is_on) {
  if (!parts_.machine.capabilities().places_axes)
    return refuse("no machine lock: the axes of this machine are moved by a device");
  return set_between_runs("machine lock", &OperatorPanel::machine_lock, is_on);
}

Reply PanelController::set_between_runs(const char* what, bool OperatorPanel::*which, bool is_on) {
  if (parts_.run.session)
    return refuse(fmt::format("{} is changed only without a run: {} is active", what,
                              parts_.run.session->run().run));
  OperatorPanel panel = parts_.machine.panel();
  panel.*which = is_on;
  parts_.machine.set_panel(panel);
  return {};
}

/// The record is staged before the machine ends the run.
void PanelController::switch_emergency_stop(bool is_pressed) {
  OperatorPanel panel = parts_.machine.panel();
  if (panel.emergency_stop == is_pressed) return;
  panel.emergency_stop = is_pressed;
  if (is_pressed) parts_.consent.set_enabled(false);
  process::log_warning("emergency stop {} {}", is_pressed ? "pressed" : "released",
                       parts_.run.label());
  if (is_pressed && parts_.run.is_active()) {
    parts_.run.was_emergency_stopped = true;
    parts_.recorder.note_emergency_stop(parts_.machine.status().origin);
  }
  parts_.machine.set_panel(panel);
}

Reply PanelController::set_emergency_stop(bool is_pressed, bool is_at_panel) {
  switch_emergency_stop(is_pressed);
  if (is_pressed) return {true, answer_of_press(parts_.emergency_stop.press(is_at_panel))};
  return {true, answer_of_release(parts_.emergency_stop.release())};
}

Reply PanelController::set_remote_enable(bool is_enabled) {
  if (parts_.consent.is_unattended())
    return refuse("this machine is unattended (--unattended yes): the network may start it");
  if (is_enabled && parts_.machine.panel().emergency_stop)
    return refuse(std::string(kEmergencyStopIsPressed));
  if (parts_.consent.is_given() == is_enabled) return {};
  parts_.consent.set_enabled(is_enabled);
  const std::string text = fmt::format("remote enable {}", is_enabled ? "on" : "off");
  process::log_warning("{} {}", text, parts_.run.label());
  parts_.recorder.note_at_panel(parts_.machine.status().origin, text);
  return {};
}

std::optional<Reply> PanelController::refusal_without_consent(const dds::Command& command) const {
  const bool releases = command.action == CommandAction::Switch &&
                        command.argument == "emergency_stop" && command.value == 0;
  if (releases && parts_.emergency_stop.is_pressed_at_panel())
    return refuse("the emergency stop was pressed at the machine's panel: release it there");
  if (parts_.consent.is_given() || !needs_consent(command, parts_.machine.panel()))
    return std::nullopt;
  return refuse(std::string(kNoConsent));
}

/// A switch with positions has none between them.
std::optional<std::string> PanelController::refusal_of_feed(double factor) const {
  if (!tables_.feed.empty()) return refusal_of(tables_.feed, factor);
  const interpreter::FeedOverrideSwitch& dial = parts_.dialect.feed_override_switch;
  if (dial.step <= 0) return std::nullopt;
  const double position = factor / dial.step;
  if (factor <= dial.most + kNoise && std::fabs(position - std::round(position)) <= kNoise)
    return std::nullopt;
  return fmt::format("{:.4g} %: this control's knob goes in steps of {:.4g} to {:.4g} %",
                     factor * 100, dial.step * 100, dial.most * 100);
}

std::optional<std::string> PanelController::refusal_of_spindle(double factor) const {
  if (!tables_.spindle.empty()) return refusal_of(tables_.spindle, factor);
  if (factor >= kMinSpindle && factor <= kMaxSpindle) return std::nullopt;
  return fmt::format("{:.4g} %: expected {}", factor * 100,
                     range_of(CommandAction::SpindleOverride));
}

Reply PanelController::set_override(const dds::Command& command) {
  if (!has_override(parts_.machine.capabilities(), command.action))
    return refuse(fmt::format("this machine has no {}", dds::to_string(command.action)));
  OperatorPanel panel = parts_.machine.panel();
  dds::override_of(command.action, panel) = command.value;
  if (!std::isfinite(command.value) || panel.clamped() != panel)
    return refuse(
        fmt::format("{:.4g} %: expected {}", command.value * 100, range_of(command.action)));
  std::optional<std::string> refusal;
  if (command.action == CommandAction::FeedOverride) refusal = refusal_of_feed(command.value);
  if (command.action == CommandAction::SpindleOverride) refusal = refusal_of_spindle(command.value);
  if (refusal) return refuse(*std::move(refusal));
  parts_.machine.set_panel(panel);
  return {};
}

/// The feed switch decides how much program time a click is.
Reply PanelController::turn_handwheel(const dds::Command& command) {
  if (!parts_.machine.panel().handwheel)
    return refuse("the handwheel does not drive the program: switch handwheel on first");
  if (!(command.value >= 1 && command.value <= kMaxClicks) ||
      command.value != std::floor(command.value))
    return refuse(fmt::format("{} clicks: expected a whole number from 1 to {}, forward only",
                              command.value, kMaxClicks));
  const auto& clicks = tables_.click_seconds;
  const std::size_t position = position_of(tables_.feed, parts_.machine.panel().feed_override);
  const double click = clicks.at(std::min(position, clicks.size() - 1));
  parts_.machine.turn_handwheel(machine::Seconds{command.value * click});
  return {};
}

}  // namespace dripline::gateway
