#pragma once

#include "gateway/interpreter/core/dialect.hpp"

namespace dripline::interpreter {

/// RS274/NGC: the NIST language, version 3, and what LinuxCNC made of it.
extern const Dialect kRs274NgcDialect;

}  // namespace dripline::interpreter
