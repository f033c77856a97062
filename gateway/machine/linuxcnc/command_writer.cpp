#include "gateway/machine/linuxcnc/command_writer.hpp"

#include <cmath>

#include "protocol/base/decimal.hpp"

namespace dripline::machine::linuxcnc {

using interpreter::SpindleState;
using streamed::Refusal;

void LinuxCncCommands::begin(const streamed::TextRules& rules) {
  CommandWriter::begin(rules);
  spindle_.clear();
}

std::optional<Refusal> LinuxCncCommands::spindle(const interpreter::Spindle& event, Lines& lines) {
  if (auto refusal = CommandWriter::spindle(event, lines)) return refusal;
  spindle_ = event.state == SpindleState::Off ? "" : lines.back();
  return std::nullopt;
}

std::optional<Refusal> LinuxCncCommands::tool(const interpreter::ToolChange& event, Lines& lines) {
  if (event.number < 0)
    return Refusal{"MCH0008", fmt::format("this machine has no tool {}", event.number)};
  if (event.is_in_spindle) {
    lines.push_back(fmt::format("M61Q{}", event.number));
    return std::nullopt;
  }
  lines.push_back(fmt::format("T{}", event.number));
  if (event.is_preselection) return std::nullopt;
  lines.emplace_back("M6");
  if (!spindle_.empty()) lines.push_back(spindle_);
  return std::nullopt;
}

std::optional<Refusal> LinuxCncCommands::miscellaneous(const interpreter::Miscellaneous& event,
                                                       Lines& lines) {
  if (event.code == streamed::kToolChangeFunction) return std::nullopt;
  if (event.code == 52 && event.p) {
    lines.emplace_back(*event.p == 0 ? "M52P0" : "M52P1");
    return std::nullopt;
  }
  const bool is_analog = event.code == 67 || event.code == 68;
  if (!is_analog && (event.code < 100 || event.code > 199))
    return Refusal{"MCH0008", fmt::format("this machine cannot do M{}", event.code)};
  constexpr int kDecimals = 6;  // as many as LinuxCNC hands on
  for (const auto& word : {event.e, event.p, event.q})
    if (!std::isfinite(word.value_or(0)))
      return Refusal{"MCH0006", fmt::format("a word of M{} without a value", event.code)};
  std::string line = is_analog ? "M68" : fmt::format("M{}", event.code);
  if (event.e) line += fmt::format("E{:.0f}", *event.e);
  if (event.p) line += "P" + decimal_text(*event.p, kDecimals);
  if (event.q) line += "Q" + decimal_text(*event.q, kDecimals);
  lines.push_back(std::move(line));
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
