#pragma once

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// G73, G74, G81 to G89: holes, each a row of steps (10, 15.3).
namespace dripline::interpreter::rs274ngc {

bool execute_cycle(Run& run, int g_code);

}  // namespace dripline::interpreter::rs274ngc
