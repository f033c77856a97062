#pragma once

#include <array>

#include "gateway/interpreter/core/interpreter.hpp"

namespace dripline::machine {

/// Lengths of a tool along X (a lathe's as a radius), Y and Z, mm.
using ToolLengths = std::array<double, 3>;
/// Those that an axis of a real machine takes in: none that machine coordinates have placed.
ToolLengths axis_lengths_of(const interpreter::ActiveModes& modes);

/// Of X, Y and Z; axes that are not marked stay so.
interpreter::Position plus(const interpreter::Position& position, const ToolLengths& lengths);
interpreter::Position minus(const interpreter::Position& position, const ToolLengths& lengths);

}  // namespace dripline::machine
