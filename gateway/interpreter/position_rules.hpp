#pragma once

#include <string_view>

#include "gateway/interpreter/core/position_setting.hpp"

namespace dripline::interpreter {

/// By the control's name; one that is not known has no such function.
const PositionRules& position_rules(std::string_view control);

}  // namespace dripline::interpreter
