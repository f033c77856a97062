#pragma once

#include "gateway/interpreter/interpreter.hpp"
#include "gateway/interpreter/tektronix1704/run.hpp"

namespace dripline::interpreter::tektronix {

Snapshot take_snapshot(const Run& run);
/// Errors: Unsupported (dialect, version), Corrupt; `run` is then unchanged.
Result<void> restore_snapshot(Run& run, const Snapshot& snapshot);

}  // namespace dripline::interpreter::tektronix
