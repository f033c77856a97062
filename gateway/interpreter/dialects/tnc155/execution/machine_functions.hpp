#pragma once

#include "gateway/interpreter/dialects/tnc155/run.hpp"

/// Spindle, coolant, stops and free M functions.
namespace dripline::interpreter::tnc155 {

/// M functions that act before the block's motion, and those that act after it. Functions that
/// say how the block moves, and those that call or end a program, do nothing here.
bool begin_m(Run& run, int m);
bool end_m(Run& run, int m);

/// Starts the spindle in a direction at its speed, or stops it.
void turn_spindle(Run& run, SpindleState to);
bool set_speed(Run& run, double speed);
/// STOP.
void stop(Run& run, StopKind kind);
/// Spindle and coolant, as M00, M02 and M30 do.
void switch_off(Run& run);

}  // namespace dripline::interpreter::tnc155
