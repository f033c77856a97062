#pragma once

#include "gateway/interpreter/core/dialect.hpp"

namespace dripline::interpreter {

/// Milltronics Centurion 5T/6T lathe control.
extern const Dialect kCenturionDialect;

}  // namespace dripline::interpreter
