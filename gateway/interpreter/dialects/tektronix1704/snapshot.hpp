#pragma once

#include "gateway/interpreter/core/interpreter.hpp"
#include "gateway/interpreter/dialects/tektronix1704/run.hpp"

namespace dripline::interpreter::tektronix1704 {

Snapshot take_snapshot(const Run& run);
/// Errors: Unsupported (dialect, version), Corrupt; `run` is then unchanged.
Result<void> restore_snapshot(Run& run, const Snapshot& snapshot);

}  // namespace dripline::interpreter::tektronix1704
