#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "storage/store.hpp"

namespace dripline::feeds {

/// The library names under which a program that another one calls by `name` may be kept, the most
/// literal first: `O0002` may be stored as O0002, O2, O0002.nc, O2.nc ...
std::vector<std::string> library_names(std::string_view name);

/// The revision a run uses for the name a program called: the newest one that existed when the run
/// was created, so that every request of a run, also after a restart of the server, gets the same
/// text. Errors: NotFound, naming what was looked for.
Result<storage::Revision> resolve_called_program(storage::Store& store, const storage::Run& run,
                                                 const std::string& name);

}  // namespace dripline::feeds
