#pragma once

#include "gateway/interpreter/core/dialect.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "protocol/base/result.hpp"

namespace dripline::interpreter::centurion {

/// The override tables (manual: overrides) and what drives a program by handwheel, from the options
/// `feed_overrides`, `spindle_overrides` (per cent), `handwheel_pulses` (of a click, for each
/// position of the feed switch) and `cranking_minutes` (of the program, for one revolution of 400
/// pulses). Errors: Syntax, LimitExceeded.
Result<PanelTables> read_panel_tables(const Setup& setup);

}  // namespace dripline::interpreter::centurion
