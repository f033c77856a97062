#pragma once

#include "gateway/interpreter/dialects/tnc155/run.hpp"

namespace dripline::interpreter::tnc155 {

/// Changes whenever the bytes of a state do.
inline constexpr std::uint32_t kSnapshotVersion = 6;

Snapshot take_snapshot(const Run& run);
/// Errors: Unsupported, Corrupt; the run is then unchanged.
Result<void> restore_snapshot(Run& run, const Snapshot& snapshot);

}  // namespace dripline::interpreter::tnc155
