#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

/// What the rows of the G codes (g_codes.cpp) name for codes that do not move: the modes, zeroes
/// and transformations, and G990 to G999. A function that serves several codes looks at the row for
/// which one it is.
namespace dripline::interpreter::centurion {

bool set_motion(Run& run, const GRow& row);
bool set_exact_stop(Run& run, const GRow& row);
/// G10 begins a list of parameters; G11 puts it into force as a whole.
bool set_data_mode(Run& run, const GRow& row);
bool set_units(Run& run, const GRow& row);
bool set_safe_zone(Run& run, const GRow& row);
bool set_return_level(Run& run, const GRow& row);
bool set_compensation(Run& run, const GRow& row);
bool cancel_tool_length(Run& run, const GRow& row);
bool set_work_system(Run& run, const GRow& row);
bool set_path_mode(Run& run, const GRow& row);
bool set_distance_mode(Run& run, const GRow& row);
bool set_spindle_unit(Run& run, const GRow& row);
bool set_feed_unit(Run& run, const GRow& row);

// Zeroes and transformations (coordinates.cpp; manual: G50, G12, G52; mirror, scaling and
// rotation). The program's position follows.
bool set_floating_zero(Run& run);
bool set_local_zero(Run& run);
bool set_mirror(Run& run);
bool set_scaling(Run& run);
bool set_rotation(Run& run);
bool clear_floating_zero(Run& run, const GRow& row);
bool end_mirror(Run& run, const GRow& row);
bool end_scaling(Run& run, const GRow& row);
bool end_rotation(Run& run, const GRow& row);

/// G990 keeps L user parameters from P on in file Q of the control, G991 restores them; defaults:
/// P0, L10, Q0 (memory/pins.cpp).
bool save_parameters(Run& run, const GRow& row);
bool load_parameters(Run& run, const GRow& row);
/// G995: P0 = PB[P1]; G996: PB[P1] = P0.
bool read_byte_parameter(Run& run, const GRow& row);
bool write_byte_parameter(Run& run, const GRow& row);
/// G997: the error whose number is in P1, none for 0.
bool force_error(Run& run, const GRow& row);
bool beep(Run& run, const GRow& row);
bool force_fatal_error(Run& run, const GRow& row);

}  // namespace dripline::interpreter::centurion
