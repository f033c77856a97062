#include "gateway/machine/streamed/command_writer.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/base/decimal.hpp"

namespace dripline::machine::streamed {

using interpreter::SpindleState;

namespace {

std::optional<Refusal> check_speed(double rpm, const TextRules& rules) {
  if (!(rpm >= 0 && std::isfinite(rpm)))
    return Refusal{"MCH0006", "a spindle speed without a value"};
  if (rules.max_rpm && rpm > *rules.max_rpm)
    return Refusal{"MCH0010",
                   fmt::format("spindle speed {:.6g} is above the machine's {:.6g} rpm{}", rpm,
                               *rules.max_rpm, rules.max_rpm_setting)};
  if (rpm > 0 && rules.min_rpm && rpm < *rules.min_rpm)
    return Refusal{"MCH0010",
                   fmt::format("spindle speed {:.6g} is below the machine's {:.6g} rpm{}", rpm,
                               *rules.min_rpm, rules.min_rpm_setting)};
  return std::nullopt;
}

}  // namespace

void CommandWriter::begin(const TextRules& rules) {
  rules_ = rules;
  flood_ = mist_ = false;
}

std::optional<Refusal> CommandWriter::spindle(const interpreter::Spindle& event, Lines& lines) {
  if (event.state == SpindleState::Oriented)
    return Refusal{"MCH0008", "this machine cannot orient the spindle"};
  if (event.state == SpindleState::Off) {
    lines.emplace_back("M5");
    return std::nullopt;
  }
  if (event.state == SpindleState::Counterclockwise && !rules_.has_reverse)
    return Refusal{"MCH0008", "this machine cannot turn the spindle counterclockwise"};
  if (event.surface_speed)
    return Refusal{"MCH0008", "this machine cannot keep a constant surface speed"};
  const double rpm = event.max_revolutions
                         ? std::min(event.revolutions_per_minute, *event.max_revolutions)
                         : event.revolutions_per_minute;
  if (auto refusal = check_speed(rpm, rules_)) return refusal;
  lines.push_back((event.state == SpindleState::Clockwise ? "M3S" : "M4S") + decimal_text(rpm, 3));
  return std::nullopt;
}

/// One command switches both off, and none both on.
std::optional<Refusal> CommandWriter::coolant(const interpreter::Coolant& event, Lines& lines) {
  if (event.mist && !rules_.has_mist)
    return Refusal{"MCH0008", "this machine cannot switch mist coolant"};
  const bool has_off = (flood_ && !event.flood) || (mist_ && !event.mist);
  if (has_off || (!event.flood && !event.mist)) lines.emplace_back("M9");
  if (event.mist) lines.emplace_back("M7");
  if (event.flood) lines.emplace_back("M8");
  flood_ = event.flood;
  mist_ = event.mist;
  return std::nullopt;
}

}  // namespace dripline::machine::streamed
