#pragma once

#include "gateway/interpreter/core/dialect.hpp"

namespace dripline::interpreter {

/// ProtoTRAK Plus: a two-axis mill that stores events.
extern const Dialect kProtoTrakDialect;

}  // namespace dripline::interpreter
