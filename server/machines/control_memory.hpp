#pragma once

#include <string>

#include "protocol/base/result.hpp"
#include "server/machines/run_sources.hpp"

namespace dripline::machines {

/// Whether the machine's control can keep the run's program, with all it calls, in its own memory.
/// Checked only where the control keeps its programs by the machine's newest setup; what is
/// drip-fed has no such limits. Errors: LimitExceeded, in the control's words.
Result<void> check_control_memory(const RunSources& sources, const storage::Run& run);

/// The revision a run uses for the name a program called: the one that its release pins, and
/// nothing else where it pins what is called; otherwise the one that its machine has got text of
/// (RunStore::calls); otherwise the newest one that was in force, and that it was allowed to call,
/// when the run was stored. So every request of a run, also after a restart of the server, gets the
/// same text. No time decides it (Revision::was_in_force_for). Errors: NotFound, naming what was
/// searched for, Corrupt (Releases::check_call).
Result<storage::Revision> resolve_called_program(const RunSources& sources, const storage::Run& run,
                                                 const std::string& name);

}  // namespace dripline::machines
