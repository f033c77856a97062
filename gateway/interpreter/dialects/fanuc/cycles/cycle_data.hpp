#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// What a block of a hole cycle says: its levels, Q, P and repeats.
namespace dripline::interpreter::fanuc {

bool is_tapping(std::uint8_t code);
/// A rigid tap goes down in strokes of Q, unless there is none or it is 0.
bool pecks_in_tap(const Run& run);
/// The factor of G51; 1 without it.
double scale_along(const ModalState& state, Axis axis);
/// The word of the hole's own axis.
Address level_word(const Run& run);

// False: an alarm.

bool read_repeats(Run& run, double& repeats);
/// Z, R, Q and P of the block; R counts from the initial level in G91, Z from R.
bool keep_data(Run& run, double present);
bool check_pecks(Run& run, double repeats);
/// Whether the initial level is where it was when the mode began: under another zero a control
/// returns to the one level or to the other.
bool check_initial_level(Run& run);

/// Rapids end at R, and go on to the initial level: R lies between it and the bottom. What else is
/// written runs, as on the control, but not without a word.
void check_levels(Run& run);

}  // namespace dripline::interpreter::fanuc
