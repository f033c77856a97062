#pragma once

#include "protocol/base/result.hpp"
#include "storage/store.hpp"

namespace dripline::machines {

/// Whether the machine's control can keep the run's program, with all it calls, in its own memory.
/// Checked only where the control keeps its programs by the machine's newest setup; what is
/// drip-fed has no such limits. Errors: LimitExceeded, in the control's words.
Result<void> check_control_memory(const storage::Store& store, const storage::Run& run);

}  // namespace dripline::machines
