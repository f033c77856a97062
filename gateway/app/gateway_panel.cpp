#include <spdlog/spdlog.h>
#include <algorithm>
#include <cmath>

#include "gateway/app/gateway.hpp"
#include "protocol/dds/stop_commands.hpp"

/// The part of the gateway that stands at the operator's panel: switches, overrides, handwheel.
namespace dripline::gateway {

using dds::CommandAction;
using machine::OperatorPanel;

namespace {

constexpr double kNoise = 1e-6;
constexpr double kMaxClicks = 1000;  ///< in one order
/// Of a control whose setup has no table for it.
constexpr double kLeastSpindle = 0.5, kMaxSpindle = 1.2;

std::string range_of(CommandAction override) {
  if (override == CommandAction::FeedOverride)
    return fmt::format("0 to {:.4g} %", OperatorPanel::kMaxFeedOverride * 100);
  if (override == CommandAction::RapidOverride)
    return fmt::format("0 to {:.4g} %", OperatorPanel::kMaxRapidOverride * 100);
  return fmt::format("{:.4g} to {:.4g} %", kLeastSpindle * 100, kMaxSpindle * 100);
}

/// The position of a switch that stands for `factor`; the table's size when none does.
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

}  // namespace

/// The setup was already found good, or is found bad by the next start.
void Gateway::take_panel_tables(const interpreter::Setup& setup) {
  if (parts_.dialect.panel_tables == nullptr) return;
  auto tables = parts_.dialect.panel_tables(setup);
  if (tables) {
    panel_tables_ = *std::move(tables);
  } else {
    spdlog::warn("setup: {} {}", tables.error().what, label());
  }
}

Gateway::Reply Gateway::set_switch(const dds::Command& command) {
  if (command.value != 0 && command.value != 1)
    return refuse(fmt::format("a switch is 0 or 1, not {}", command.value));
  OperatorPanel panel = machine_.panel();
  const bool is_on = command.value == 1;
  if (command.argument == "emergency_stop") return set_emergency_stop(is_on);
  const machine::MotionCapabilities& can = machine_.capabilities();
  if (command.argument == "single_block") {
    if (!can.single_block) return refuse("this machine has no single_block");
    panel.single_block = is_on;
  } else if (command.argument == "optional_stop") {
    panel.optional_stop = is_on;
  } else if (command.argument == "block_skip") {
    panel.block_skip = is_on;
  } else if (command.argument == "handwheel") {
    if (panel_tables_.click_seconds.empty())
      return refuse(
          fmt::format("a handwheel drives no program of control {}", parts_.options.control));
    if (!can.handwheel) return refuse("this machine drives no program by its handwheel");
    panel.handwheel = is_on;
  } else {
    return refuse(
        fmt::format("no switch '{}': single_block, optional_stop, block_skip, handwheel, "
                    "emergency_stop",
                    command.argument));
  }
  machine_.set_panel(panel);
  const bool is_for_next_run = session_ && command.argument == "block_skip";
  return {true, is_for_next_run ? "block_skip takes effect at the next start" : ""};
}

/// Every machine has one, whatever its control. The record is there before the machine ends the
/// run.
Gateway::Reply Gateway::set_emergency_stop(bool is_pressed) {
  OperatorPanel panel = machine_.panel();
  if (panel.emergency_stop == is_pressed) return {};
  panel.emergency_stop = is_pressed;
  if (is_pressed) consent_.set_enabled(false);
  spdlog::warn("emergency stop {} {}", is_pressed ? "pressed" : "released", label());
  if (is_pressed && session_ && !is_ending_) {
    was_emergency_stopped_ = true;
    recorder_.note_emergency_stop(machine_.status().origin);
  }
  machine_.set_panel(panel);
  return {};
}

/// Controls whose knob has positions do not stand between them.
std::optional<std::string> Gateway::refusal_of_feed(double factor) const {
  if (!panel_tables_.feed.empty()) return refusal_of(panel_tables_.feed, factor);
  const interpreter::FeedOverrideSwitch& dial = parts_.dialect.feed_override_switch;
  if (dial.step <= 0) return std::nullopt;
  const double position = factor / dial.step;
  if (factor <= dial.most + kNoise && std::fabs(position - std::round(position)) <= kNoise)
    return std::nullopt;
  return fmt::format("{:.4g} %: this control's knob goes in steps of {:.4g} to {:.4g} %",
                     factor * 100, dial.step * 100, dial.most * 100);
}

std::optional<std::string> Gateway::refusal_of_spindle(double factor) const {
  if (!panel_tables_.spindle.empty()) return refusal_of(panel_tables_.spindle, factor);
  if (factor >= kLeastSpindle && factor <= kMaxSpindle) return std::nullopt;
  return fmt::format("{:.4g} %: expected {}", factor * 100,
                     range_of(CommandAction::SpindleOverride));
}

namespace {

bool has_override(const machine::MotionCapabilities& machine, CommandAction override) {
  if (override == CommandAction::FeedOverride) return machine.feed_override;
  if (override == CommandAction::RapidOverride) return machine.rapid_override;
  return machine.spindle_override;
}

}  // namespace

Gateway::Reply Gateway::set_override(const dds::Command& command) {
  if (!has_override(machine_.capabilities(), command.action))
    return refuse(fmt::format("this machine has no {}", dds::to_string(command.action)));
  OperatorPanel panel = machine_.panel();
  dds::override_of(command.action, panel) = command.value;
  if (!std::isfinite(command.value) || panel.clamped() != panel)
    return refuse(
        fmt::format("{:.4g} %: expected {}", command.value * 100, range_of(command.action)));
  std::optional<std::string> refusal;
  if (command.action == CommandAction::FeedOverride) refusal = refusal_of_feed(command.value);
  if (command.action == CommandAction::SpindleOverride) refusal = refusal_of_spindle(command.value);
  if (refusal) return refuse(*std::move(refusal));
  machine_.set_panel(panel);
  return {};
}

/// The feed switch says how much a click is.
Gateway::Reply Gateway::turn_handwheel(const dds::Command& command) {
  if (!machine_.panel().handwheel)
    return refuse("the handwheel does not drive the program: switch handwheel on first");
  if (!(command.value >= 1 && command.value <= kMaxClicks) ||
      command.value != std::floor(command.value))
    return refuse(fmt::format("{} clicks: expected a whole number from 1 to {}, forward only",
                              command.value, kMaxClicks));
  const auto& clicks = panel_tables_.click_seconds;
  const std::size_t position = position_of(panel_tables_.feed, machine_.panel().feed_override);
  const double click = clicks.at(std::min(position, clicks.size() - 1));
  machine_.turn_handwheel(machine::Seconds{command.value * click});
  return {};
}

}  // namespace dripline::gateway
