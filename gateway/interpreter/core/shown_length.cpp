#include "gateway/interpreter/core/shown_length.hpp"

#include <fmt/core.h>

namespace dripline::interpreter {
namespace {

bool is_doubled(Axis axis, const LengthDisplay& display) {
  return axis == Axis::X && display.x_is_diameter;
}

/// Without zeros at its end, and without "-0".
std::string rounded(double value) {
  std::string text = fmt::format("{:.4f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string_view name_of(Units units) {
  return units == Units::Inch ? "in" : "mm";
}

}  // namespace

std::string shown_number(Length length, Units units) {
  return rounded(units == Units::Inch ? length.inch() : length.mm());
}

std::string shown_length(Length length, Units units) {
  return fmt::format("{} {}", shown_number(length, units), name_of(units));
}

std::string shown_axis_number(Axis axis, double value, const LengthDisplay& display) {
  if (is_rotary(axis)) return rounded(value);
  return shown_number(Length::mm(is_doubled(axis, display) ? 2 * value : value), display.units);
}

std::string shown_axis(Axis axis, double value, const LengthDisplay& display) {
  return fmt::format("{}{} {}", letter(axis), is_doubled(axis, display) ? " diameter" : "",
                     shown_axis_number(axis, value, display));
}

std::string_view shown_unit(Axis axis, Units units) {
  return is_rotary(axis) ? "degrees" : name_of(units);
}

}  // namespace dripline::interpreter
