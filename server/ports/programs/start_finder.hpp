#pragma once

#include <cstdint>

#include "server/machines/machine_control.hpp"
#include "storage/store.hpp"

namespace dripline::ports {

/// A place in a program.
struct ProgramPlace {
  std::uint64_t byte = 0;
  std::uint64_t line = 1;  ///< 1-based; the block that holds the byte
};

/// Finds where a run is to begin: reads stored content piece by piece, in bounded memory. Errors:
/// NotFound (the program has no such byte, line or N number; names the last one there is), Corrupt,
/// Io.
Result<ProgramPlace> find_start(storage::ProgramStore& store, const storage::Run& run,
                                const machines::StartPoint& from);

}  // namespace dripline::ports
