#pragma once

#include <string>

#include "gateway/interpreter/core/event.hpp"

/// Lengths in texts for the people at a control: in the units of the program, X of a lathe as the
/// diameter that its programs have, and never finer than a control resolves.
namespace dripline::interpreter {

struct LengthDisplay {
  Units units = Units::Millimeter;
  bool x_is_diameter = false;
};

/// "1.5", "-38.1": at most four decimals.
std::string shown_number(Length length, Units units);
/// "1.5 in", "-38.1 mm"
std::string shown_length(Length length, Units units);
/// "X diameter -2.54", "Z 1.5"; a rotary axis in degrees. `value`: as Position::raw.
std::string shown_axis(Axis axis, double value, const LengthDisplay& display);
/// The number alone: of a limit, after shown_axis.
std::string shown_axis_number(Axis axis, double value, const LengthDisplay& display);
/// "in", "mm"; of a rotary axis "degrees"
std::string_view shown_unit(Axis axis, Units units);

}  // namespace dripline::interpreter
