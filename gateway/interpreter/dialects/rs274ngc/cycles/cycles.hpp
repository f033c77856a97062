#pragma once

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// Canned cycles (NIST 3.5; LinuxCNC: G73, G74, G76).
namespace dripline::interpreter::rs274ngc {

/// G73, G74, G81 to G89: holes, each a row of steps.
bool execute_cycle(Run& run, int g_code);

// Moves that follow the spindle; thread.cpp.

/// G33: K of travel per revolution. G33.1: there and back, the spindle reversed.
bool synchronized_move(Run& run, int g_code);

/// G76: a thread in many passes, in the ZX plane.
bool thread_cycle(Run& run);

}  // namespace dripline::interpreter::rs274ngc
