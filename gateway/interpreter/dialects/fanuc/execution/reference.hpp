#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// G27 to G30: reference points, which are machine coordinates.
namespace dripline::interpreter::fanuc {

/// Of the block's one-shot code, 27 to 30.
bool execute_reference(Run& run);

}  // namespace dripline::interpreter::fanuc
