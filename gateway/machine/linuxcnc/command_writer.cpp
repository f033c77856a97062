#include "gateway/machine/linuxcnc/command_writer.hpp"

#include <algorithm>
#include <cmath>

namespace dripline::machine::linuxcnc {

using interpreter::SpindleState;
using streamed::Refusal;

void LinuxCncCommands::begin(const streamed::TextRules& rules) {
  max_rpm_ = rules.max_rpm;
  spindle_.clear();
  flood_ = mist_ = false;
}

std::optional<Refusal> LinuxCncCommands::spindle(const interpreter::Spindle& event, Lines& lines) {
  if (event.state == SpindleState::Oriented)
    return Refusal{"MCH0008", "this machine cannot orient the spindle"};
  if (event.state == SpindleState::Off) {
    spindle_.clear();
    lines.emplace_back("M5");
    return std::nullopt;
  }
  if (event.surface_speed)
    return Refusal{"MCH0008", "this machine cannot keep a constant surface speed"};
  const double rpm = event.max_revolutions
                         ? std::min(event.revolutions_per_minute, *event.max_revolutions)
                         : event.revolutions_per_minute;
  if (!(rpm >= 0 && std::isfinite(rpm)))
    return Refusal{"MCH0006", "a spindle speed without a value"};
  if (max_rpm_ && rpm > *max_rpm_)
    return Refusal{"LCN0008", fmt::format("spindle speed {:.6g} is above LinuxCNC's {:.6g} rpm",
                                          rpm, *max_rpm_)};
  spindle_ = fmt::format("{}S{:.3f}", event.state == SpindleState::Clockwise ? "M3" : "M4", rpm);
  lines.push_back(spindle_);
  return std::nullopt;
}

/// One command switches both off, and none both on.
std::optional<Refusal> LinuxCncCommands::coolant(const interpreter::Coolant& event, Lines& lines) {
  const bool has_off = (flood_ && !event.flood) || (mist_ && !event.mist);
  if (has_off || (!event.flood && !event.mist)) lines.emplace_back("M9");
  if (event.mist) lines.emplace_back("M7");
  if (event.flood) lines.emplace_back("M8");
  flood_ = event.flood;
  mist_ = event.mist;
  return std::nullopt;
}

std::optional<Refusal> LinuxCncCommands::tool(const interpreter::ToolChange& event, Lines& lines) {
  if (event.number < 0)
    return Refusal{"MCH0008", fmt::format("this machine has no tool {}", event.number)};
  lines.push_back(fmt::format("T{}", event.number));
  if (event.is_preselection) return std::nullopt;
  lines.emplace_back("M6");
  if (!spindle_.empty()) lines.push_back(spindle_);
  return std::nullopt;
}

std::optional<Refusal> LinuxCncCommands::miscellaneous(const interpreter::Miscellaneous& event,
                                                       Lines& lines) {
  constexpr int kToolChange = 6;  // the tool came with its number
  if (event.code == kToolChange) return std::nullopt;
  if (event.code < 100 || event.code > 199)
    return Refusal{"MCH0008", fmt::format("this machine cannot do M{}", event.code)};
  lines.push_back(fmt::format("M{}", event.code));
  return std::nullopt;
}

std::optional<Refusal> LinuxCncCommands::pin(const interpreter::PinChange& event, Lines& lines) {
  if (event.output < 0 || event.output > 63)
    return Refusal{"MCH0008", fmt::format("this machine has no output {}", event.output)};
  if (event.pulse_ms && !(*event.pulse_ms >= 0 && std::isfinite(*event.pulse_ms)))
    return Refusal{"MCH0006", "a pulse without a length"};
  lines.push_back(fmt::format("{}P{}", event.state ? "M64" : "M65", event.output));
  if (!event.pulse_ms) return std::nullopt;
  lines.push_back(fmt::format("G4P{:.3f}", *event.pulse_ms / 1000));
  lines.push_back(fmt::format("{}P{}", event.state ? "M65" : "M64", event.output));
  return std::nullopt;
}

}  // namespace dripline::machine::linuxcnc
