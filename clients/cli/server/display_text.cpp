#include "clients/cli/server/display_text.hpp"

#include <fmt/format.h>

#include "protocol/base/units.hpp"

namespace dripline::cli {
namespace {

bool is_inch(const client::Display& display) {
  return display.units == "inch";
}

double in_units(double mm, const client::Display& display) {
  return is_inch(display) ? Length::mm(mm).inch() : mm;
}

/// As many decimals as controls show.
std::string number_text(double mm, const client::Display& display) {
  return fmt::format("{:.{}f}", in_units(mm, display), is_inch(display) ? 4 : 3);
}

std::string axis_text(char axis, double value, const client::Display& display) {
  const bool is_rotary = axis == 'A' || axis == 'B' || axis == 'C';
  if (is_rotary) return fmt::format("{} {:.3f}", axis, value);
  if (axis == 'X' && display.x == "diameter")
    return fmt::format("X dia {}", number_text(2 * value, display));
  return fmt::format("{} {}", axis, number_text(value, display));
}

}  // namespace

client::Display display_of(const client::Machine& machine) {
  return machine.display.value_or(client::Display{});
}

std::string_view unit_name(const client::Display& display) {
  return is_inch(display) ? "in" : "mm";
}

std::string length_text(double mm, const client::Display& display) {
  return fmt::format("{} {}", number_text(mm, display), unit_name(display));
}

std::string feed_text(double mm, const client::Display& display) {
  const double feed = in_units(mm, display);
  return is_inch(display) ? fmt::format("{:.2f} in/min", feed) : fmt::format("{:.0f} mm/min", feed);
}

std::string axes_text(const std::map<std::string, double>& axes, const client::Display& display) {
  std::string text;
  // JSON objects do not keep an order.
  constexpr std::string_view kOrder = "XYZABCUVW";
  for (const char axis : kOrder) {
    const auto found = axes.find(std::string(1, axis));
    if (found == axes.end()) continue;
    text += (text.empty() ? "" : " ") + axis_text(axis, found->second, display);
  }
  return text;
}

}  // namespace dripline::cli
