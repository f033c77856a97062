#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

namespace dripline::interpreter::centurion {

/// What the block of G70-G73 says; kept in `cycle` and in P110-P119. False with an alarm.
bool read_pattern_words(Run& run, PatternCycle& cycle, std::uint32_t& first_label);

}  // namespace dripline::interpreter::centurion
