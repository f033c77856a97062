#pragma once

#include "gateway/interpreter/core/dialect.hpp"

namespace dripline::interpreter::centurion {

/// For graphics, never for a machine: the control as it draws a program's part path (manual:
/// verify, PART). The moves are those programmed, without nose compensation; of G71 to G73 they are
/// the pattern, followed once.
Dialect part_path_dialect();

}  // namespace dripline::interpreter::centurion
