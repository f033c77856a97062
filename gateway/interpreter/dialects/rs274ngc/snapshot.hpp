#pragma once

#include "gateway/interpreter/core/interpreter.hpp"
#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

namespace dripline::interpreter::rs274ngc {

inline constexpr std::uint32_t kSnapshotVersion = 4;

Snapshot take_snapshot(const Run& run);
/// Errors: Unsupported, Corrupt; the run is then unchanged.
Result<void> restore_snapshot(Run& run, const Snapshot& snapshot);

}  // namespace dripline::interpreter::rs274ngc
