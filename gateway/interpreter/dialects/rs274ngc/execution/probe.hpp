#pragma once

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// G38.2 to G38.5 (9.4, 16.5).
namespace dripline::interpreter::rs274ngc {

/// Asks for the probe's result; with the answer the line is finished.
bool probe_move(Run& run, int g_code);

}  // namespace dripline::interpreter::rs274ngc
