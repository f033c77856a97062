#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

namespace dripline::interpreter::fanuc {

/// A G word of the block: the code that its number is in the G-code system of the machine, and its
/// modal group. False: alarm 010, or one of a call.
bool add_g(Run& run, const Word& word);

}  // namespace dripline::interpreter::fanuc
