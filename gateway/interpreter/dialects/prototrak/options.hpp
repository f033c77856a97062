#pragma once

#include "gateway/interpreter/core/setup.hpp"
#include "protocol/base/result.hpp"

namespace dripline::interpreter::prototrak {

/// The `[control]` options: how the operator works the machine.
struct ControlOptions {
  bool waits = true;  ///< for the operator at positions and at begin and end of a chain of cuts
};

/// Errors: Syntax, Unsupported, naming the option.
Result<ControlOptions> read_options(const Setup& setup);

}  // namespace dripline::interpreter::prototrak
