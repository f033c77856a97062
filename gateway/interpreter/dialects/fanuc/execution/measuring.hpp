#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// G37: the tool goes to a sensor whose place is known, and its length offset is corrected.
namespace dripline::interpreter::fanuc {

/// Asks; the answer comes to finish_measuring.
bool start_measuring(Run& run);
bool finish_measuring(Run& run, const ProbeResult& result);

}  // namespace dripline::interpreter::fanuc
