#include "gateway/interpreter/dialects/tnc155/memory/mod_functions.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <charconv>
#include <cmath>

namespace dripline::interpreter::tnc155 {
namespace {

/// `raw`: millimeters, of a rotary axis degrees.
std::string coordinate_text(Axis axis, double raw, Units units) {
  if (is_rotary(axis)) return fmt::format("{:+.3f} deg", raw);
  const Length length = Length::mm(raw);
  return units == Units::Inch ? fmt::format("{:+.4f} inch", length.inch())
                              : fmt::format("{:+.3f} mm", length.mm());
}

std::string limit_text(const Position& limits, Axis axis, Units units) {
  if (!limits.has(axis) || std::abs(limits.raw(axis)) >= kFarthestLimit) return "off";
  return coordinate_text(axis, limits.raw(axis), units);
}

/// Both ends of each axis, in machine coordinates.
void add_limits(const ModSettings& settings, std::vector<ModFunction>& menu) {
  const std::pair<std::string_view, Axis> axes[] = {
      {"X", Axis::X}, {"Y", Axis::Y}, {"Z", Axis::Z}, {"IV", settings.fourth_axis}};
  const Units units = settings.display_units;
  for (const auto& [name, axis] : axes) {
    const std::string range = coordinate_text(axis, -kFarthestLimit, units) + " to " +
                              coordinate_text(axis, kFarthestLimit, units);
    menu.push_back(
        {fmt::format("LIMIT {}+", name), limit_text(settings.limit_high, axis, units), range});
    menu.push_back(
        {fmt::format("LIMIT {}-", name), limit_text(settings.limit_low, axis, units), range});
  }
}

std::string or_dash(const std::string& text) {
  return text.empty() ? "-" : text;
}

}  // namespace

std::string range_text(const UserParameter& parameter) {
  const auto text = [](double number) { return fmt::format("{:.12g}", number); };
  if (!parameter.min) return parameter.max ? "at most " + text(*parameter.max) : "";
  if (!parameter.max) return "at least " + text(*parameter.min);
  return text(*parameter.min) + " to " + text(*parameter.max);
}

Result<void> check_value(const UserParameter& parameter, double value) {
  const bool is_below = parameter.min && value < *parameter.min;
  const bool is_above = parameter.max && value > *parameter.max;
  if (!is_below && !is_above) return {};
  return fail(Errc::LimitExceeded, "{} (MP{}): {:.12g} is not {}", parameter.text,
              parameter.parameter, value, range_text(parameter));
}

std::vector<ModFunction> mod_functions(const ModSettings& settings, std::size_t vacant) {
  std::vector<ModFunction> menu{
      {"VACANT BLOCKS", std::to_string(vacant), fmt::format("of {}", settings.memory_blocks)},
      {"CHANGE MM/INCH", settings.display_units == Units::Inch ? "inch" : "mm", "mm, inch"},
      {"POSITION DATA",
       std::string(kPositionDisplays[static_cast<std::size_t>(settings.position_display)]),
       "ACTL, REF, LAG, NOML, DIST"},
      {"POSITION DISPLAY", settings.is_display_large ? "large" : "small",
       "small, large (not in ISO)"},
      {"BLOCK NUMBER INCREMENT", std::to_string(settings.block_increment),
       fmt::format("0 to {}; 0: no numbers", kHighestIncrement)},
      {"BAUD RATE", settings.baud_rate ? std::to_string(*settings.baud_rate) : "-",
       "110, 150, 300, 600, 1200, 2400, 4800, 9600"}};
  add_limits(settings, menu);
  menu.push_back({"NC SOFTWARE NUMBER", or_dash(settings.nc_software), "as 227 020 08"});
  menu.push_back({"PLC SOFTWARE NUMBER", or_dash(settings.plc_software), "as 228 601 01"});
  menu.push_back({"USER PARAMETERS", std::to_string(settings.user_parameters.size()),
                  fmt::format("at most {}", kMaxUserParameters)});
  menu.push_back({"CODE NUMBER", "-", "86357: program protection off (dnc edit --unprotect)"});
  return menu;
}

Result<std::size_t> find_user_parameter(const ModSettings& settings, std::string_view name) {
  const auto& parameters = settings.user_parameters;
  std::size_t place = 0;
  const auto read = std::from_chars(name.data(), name.data() + name.size(), place);
  const bool is_place = read.ec == std::errc{} && read.ptr == name.data() + name.size();
  if (is_place && place >= 1 && place <= parameters.size()) return place - 1;
  std::string known;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const UserParameter& parameter = parameters[i];
    const std::string machine = fmt::format("MP{}", parameter.parameter);
    if (name == parameter.text || name == machine) return i;
    known += fmt::format("{}{} {} ({})", i == 0 ? "" : ", ", i + 1, parameter.text, machine);
  }
  return fail(Errc::NotFound, "'{}' is no user parameter; {}", name,
              known.empty() ? "the setup has none" : "there are: " + known);
}

}  // namespace dripline::interpreter::tnc155
