#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

namespace dripline::interpreter::centurion {

/// G74 (grooves in a face, high-speed pecks) and G75 (grooves in a diameter), spec 11.9, 11.10: the
/// same cycle along Z and along X. Nothing moves before every word has been found good.
/// Errors: 517, 519, CycleTooLong.
bool run_groove_cycle(Run& run);

}  // namespace dripline::interpreter::centurion
