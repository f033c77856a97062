#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

namespace dripline::interpreter::centurion {

inline constexpr std::uint32_t kSnapshotVersion = 5;

/// The run's state between two blocks.
Snapshot take_snapshot(const Run& run);
/// Errors: Unsupported (another dialect or version), Corrupt. `run` is then unchanged.
Result<void> restore_snapshot(Run& run, const Snapshot& snapshot);

}  // namespace dripline::interpreter::centurion
