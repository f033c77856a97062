#pragma once

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// Curves in the XY plane, given as straight pieces within the option `spline_tolerance` (16.5).
namespace dripline::interpreter::rs274ngc {

/// G5 and G5.1: cubic and quadratic curves.
bool spline_move(Run& run, int g_code);

/// What every curve asks for: G17, no compensation, no axes but X and Y.
bool check_spline(Run& run);

}  // namespace dripline::interpreter::rs274ngc
