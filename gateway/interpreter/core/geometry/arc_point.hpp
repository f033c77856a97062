#pragma once

#include "gateway/interpreter/core/event.hpp"

namespace dripline::interpreter {

/// A point of an arc or helix that begins at `from`, by the angle traveled from there.
Position point_on_arc(const Arc& arc, const Position& from, double degrees);

}  // namespace dripline::interpreter
