#pragma once

#include "gateway/line/heads/place_finder.hpp"
#include "server/machines/machine_control.hpp"
#include "storage/store.hpp"

namespace dripline::ports {

/// Finds where a run is to begin: reads stored content piece by piece, in bounded memory. Errors:
/// NotFound (the program has no such byte, line, N number or tool), Unsupported (a place that only
/// a gateway finds), Corrupt, Io.
Result<line::ProgramPlace> find_start(storage::ProgramStore& store, const storage::Run& run,
                                      const machines::StartPoint& from);

/// What is sent before the rest of a program that begins at `place`: nothing, or the blocks that
/// put in force what the rest relies on. Reads the program from its beginning, piece by piece.
/// Errors: those of line::HeadScan::head, Corrupt, Io.
Result<std::string> start_head(storage::ProgramStore& store, const storage::Run& run,
                               const line::ProgramPlace& place, machines::StartHead choice);

}  // namespace dripline::ports
