#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// Work coordinates and what shifts them: G10, G22, G23, G52, G54 to G59, G92.
namespace dripline::interpreter::fanuc {

/// G54 to G59 and G54.1 P.
bool select_work_system(Run& run);
bool set_local_zero(Run& run);
bool set_position(Run& run);
/// G10 with its lists.
bool set_data(Run& run);
/// G22, G23.
bool set_stroke_zone(Run& run);

}  // namespace dripline::interpreter::fanuc
