#pragma once

#include "gateway/interpreter/rs274ngc/run.hpp"

/// G5 and G5.1: curves in the XY plane, given as straight pieces (16.5).
namespace dripline::interpreter::rs274ngc {

bool spline_move(Run& run, int g_code);

}  // namespace dripline::interpreter::rs274ngc
