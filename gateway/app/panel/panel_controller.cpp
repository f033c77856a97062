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

/// The panel's switch of a command; null when it is none of these.
bool OperatorPanel::*switch_of(std::string_view name) {
  if (name == "single_block") return &OperatorPanel::single_block;
  if (name == "optional_stop") return &OperatorPanel::optional_stop;
  if (name == "block_skip") return &OperatorPanel::block_skip;
  if (name == "handwheel") return &OperatorPanel::handwheel;
  return nullptr;
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

Reply PanelController::set_switch(const dds::Command& command) {
  const std::string& name = command.argument;
  if (command.value != 0 && command.value != 1)
    return refuse(fmt::format("a switch is 0 or 1, not {}", command.value));
  if (name == "emergency_stop") return set_emergency_stop(command.value == 1);
  const auto member = switch_of(name);
  if (member == nullptr)
    return refuse(
        fmt::format("no switch '{}': single_block, optional_stop, block_skip, handwheel, "
                    "emergency_stop",
                    name));
  const machine::MotionCapabilities& machine = parts_.machine.capabilities();
  if ((name == "single_block" && !machine.single_block) ||
      (name == "handwheel" && !machine.handwheel))
    return refuse(fmt::format("this machine has no {}", name));
  if (name == "handwheel" && tables_.click_seconds.empty())
    return refuse(fmt::format("a handwheel drives no program of control {}", parts_.dialect.name));
  OperatorPanel panel = parts_.machine.panel();
  panel.*member = command.value == 1;
  parts_.machine.set_panel(panel);
  const bool is_for_next_run = parts_.run.session && name == "block_skip";
  return {true, is_for_next_run ? "block_skip takes effect at the next start" : ""};
}

/// The record is staged before the machine ends the run.
Reply PanelController::set_emergency_stop(bool is_pressed) {
  OperatorPanel panel = parts_.machine.panel();
  if (panel.emergency_stop == is_pressed) return {};
  panel.emergency_stop = is_pressed;
  if (is_pressed) parts_.consent.set_enabled(false);
  process::log_warning("emergency stop {} {}", is_pressed ? "pressed" : "released",
                       parts_.run.label());
  if (is_pressed && parts_.run.is_active()) {
    parts_.run.was_emergency_stopped = true;
    parts_.recorder.note_emergency_stop(parts_.machine.status().origin);
  }
  parts_.machine.set_panel(panel);
  return {};
}

Reply PanelController::set_emergency_stop_at_panel(bool is_pressed) {
  is_stopped_at_panel_ = is_pressed;
  return set_emergency_stop(is_pressed);
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
  if (releases && is_stopped_at_panel_)
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
