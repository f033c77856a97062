#pragma once

#include "gateway/interpreter/core/dialect.hpp"

namespace dripline::interpreter {

extern const Dialect kTnc155Dialect;

}  // namespace dripline::interpreter
