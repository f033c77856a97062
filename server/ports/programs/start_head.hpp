#pragma once

#include <string>

#include "server/machines/machine_control.hpp"
#include "server/ports/programs/start_finder.hpp"

namespace dripline::ports {

/// What is sent before the rest of a program that begins at `place`: nothing, or the blocks that
/// put in force what the rest relies on. Reads the program from its beginning, piece by piece.
/// Errors: Conflict (the rest relies on words before it: they are named, and what can be done;
/// or some of them cannot be sent again), Corrupt, Io.
Result<std::string> start_head(storage::ProgramStore& store, const storage::Run& run,
                               const ProgramPlace& place, machines::StartHead choice);

}  // namespace dripline::ports
