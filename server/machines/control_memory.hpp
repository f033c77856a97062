#pragma once

#include "protocol/base/result.hpp"
#include "storage/store.hpp"

namespace dripline::machines {

/// Could the machine's control keep the run's program, with all it calls, in its own memory? Asked
/// only where the machine's newest setup says that the control keeps its programs; what is
/// drip-fed has no such limits. Errors: LimitExceeded, in the control's words.
Result<void> check_control_memory(const storage::Store& store, const storage::Run& run);

}  // namespace dripline::machines
