#pragma once

#include "gateway/interpreter/registry.hpp"

namespace dripline::interpreter {

extern const Dialect kTnc155Dialect;

}  // namespace dripline::interpreter
