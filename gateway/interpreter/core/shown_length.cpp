#include "gateway/interpreter/core/shown_length.hpp"

#include <fmt/core.h>

#include "protocol/base/decimal.hpp"

namespace dripline::interpreter {
namespace {

bool is_doubled(Axis axis, const LengthDisplay& display) {
  return axis == Axis::X && display.x_is_diameter;
}

/// Without zeros at its end, and without "-0".
std::string rounded(double value) {
  return decimal_text(value, 4);
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
