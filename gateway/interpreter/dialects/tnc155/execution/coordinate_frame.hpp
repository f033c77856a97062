#pragma once

#include "gateway/interpreter/core/interpreter.hpp"
#include "gateway/interpreter/dialects/tnc155/options.hpp"
#include "gateway/interpreter/dialects/tnc155/state.hpp"

namespace dripline::interpreter::tnc155 {

/// What the status window shows of datum, ROT, SCL, mirrored axes and the last CC.
CoordinateFrame frame_of(const State& state);
/// Whether rotary axes there tilt the tool against Z.
bool is_tool_tilted(const ControlOptions& options, const Position& at);

}  // namespace dripline::interpreter::tnc155
