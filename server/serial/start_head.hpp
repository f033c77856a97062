#pragma once

#include <string>

#include "server/feeds/feed_control.hpp"
#include "server/serial/start_finder.hpp"

namespace dripline::ports {

/// What is sent before the rest of a program that begins at `place`: nothing, or the blocks that
/// put in force what the rest relies on. Reads the program from its beginning, piece by piece.
/// Errors: ModalConflict (the rest relies on words before it: they are named, and what can be done;
/// or some of them can not be sent again), Corrupt, Io.
Result<std::string> start_head(storage::Store& store, const storage::Run& run,
                               const ProgramPlace& place, feeds::StartHead choice);

}  // namespace dripline::ports
