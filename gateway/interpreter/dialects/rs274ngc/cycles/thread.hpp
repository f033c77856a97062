#pragma once

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// Moves that follow the spindle: G33, G33.1 and G76 (16.5).
namespace dripline::interpreter::rs274ngc {

/// G33: K of travel per revolution. G33.1: there and back, the spindle reversed.
bool synchronized_move(Run& run, int g_code);

/// G76: a thread in many passes, in the ZX plane.
bool thread_cycle(Run& run);

}  // namespace dripline::interpreter::rs274ngc
