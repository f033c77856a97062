#pragma once

#include <map>
#include <string>

#include "clients/cli/text/table.hpp"
#include "clients/lib/api_types.hpp"

namespace dripline::cli {

/// "X 12.500 Z -3.000": in the order of the axis letters on a control's screen.
std::string axes_text(const std::map<std::string, double>& axes);

/// The five position displays of a control, and where datum, shift, rotation, scale, mirrored axes
/// and the last circle center are.
void add_coordinates(Details& details, const client::MachineStatus& status);

}  // namespace dripline::cli
