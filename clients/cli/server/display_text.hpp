#pragma once

#include <map>
#include <string>
#include <string_view>

#include "clients/lib/api_types.hpp"

/// Lengths as a control's own position display has them.

namespace dripline::cli {

/// Of a control that is not known: millimeters and radii.
client::Display display_of(const client::Machine& machine);

/// mm or in
std::string_view unit_name(const client::Display& display);
/// "12.500 mm", "0.4921 in"
std::string length_text(double mm, const client::Display& display);
/// Per minute: "200 mm/min", "7.87 in/min".
std::string feed_text(double mm, const client::Display& display);
/// "X 12.500 Z -3.000", "X dia 0.9843 Z -0.1181": in the order of the axis letters on a control's
/// screen. Rotary axes stay degrees.
std::string axes_text(const std::map<std::string, double>& axes,
                      const client::Display& display = {});

}  // namespace dripline::cli
