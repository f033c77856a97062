#pragma once

#include <string>

#include "storage/program_store.hpp"
#include "storage/run_store.hpp"

namespace dripline::machines {

/// The revision a run uses for the name a program called: the newest one that existed when the run
/// was created, so that every request of a run, also after a restart of the server, gets the same
/// text. Errors: NotFound, naming what was searched for.
Result<storage::Revision> resolve_called_program(storage::ProgramStore& store,
                                                 const storage::Run& run, const std::string& name);

}  // namespace dripline::machines
