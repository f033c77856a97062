#pragma once

#include "gateway/interpreter/dialects/tnc155/run.hpp"

namespace dripline::interpreter::tnc155 {

/// FN 0 to FN 8: sets a Q parameter. False after an alarm; the parameter keeps its value then.
bool compute(Run& run, const Block& block);
/// FN 9 to FN 12: whether the condition holds.
bool is_true(const Run& run, const Block& block);

}  // namespace dripline::interpreter::tnc155
