#pragma once

#include "gateway/interpreter/core/interpreter.hpp"
#include "gateway/interpreter/dialects/prototrak/executor.hpp"

namespace dripline::interpreter::prototrak {

struct KeptState {
  std::uint8_t phase = 0;  ///< 0: receiving, the rest is unused; 1 running, 2 ended, 3 alarmed
  StoredProgram program;
  ExecutionState execution;
  std::vector<std::byte> path;  ///< the compensator's
};

Snapshot take_snapshot(KeptState state);
/// Errors: Unsupported (dialect, version), Corrupt.
Result<KeptState> read_snapshot(const Snapshot& snapshot);

}  // namespace dripline::interpreter::prototrak
