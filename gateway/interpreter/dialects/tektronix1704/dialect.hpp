#pragma once

#include "gateway/interpreter/core/dialect.hpp"

namespace dripline::interpreter {

/// Tektronix 1704 contouring control for punched tape, two or three axes.
extern const Dialect kTektronix1704Dialect;

}  // namespace dripline::interpreter
