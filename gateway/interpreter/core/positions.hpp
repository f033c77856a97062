#pragma once

#include "gateway/interpreter/core/position_setting.hpp"

/// The functions of each control's screen that take the position of a machine at rest; in the
/// folder of its dialect (memory/position_rules.cpp). Other controls have none.
namespace dripline::interpreter {

extern const PositionRules kFanucPosition, kFanucLathePosition, kCenturionPosition,
    kRs274NgcPosition, kTncPosition;

}  // namespace dripline::interpreter
