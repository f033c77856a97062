#pragma once

#include <string>
#include <vector>

#include "gateway/interpreter/core/position_setting.hpp"

namespace dripline::gateway {

/// What was set from the position of the axes.
struct PositionChange {
  std::string text;     ///< for people: "G54.X is 87.500 mm, it was 100.000 (...)"
  std::string details;  ///< the same as JSON: {"cells": [{"name", "before", "value", "unit"}],
                        ///< "length", "zero"}
  std::string record;   ///< JSON, for the memory's report
};

struct PositionToShow {
  const interpreter::PositionSetting& setting;
  const interpreter::RestingPlace& place;
  const std::vector<interpreter::CellNumber>& changes;
  const interpreter::ReadCell& before;
  bool is_diameter = false;
  std::string who;
};

/// Lengths are as the memory has them, with the digits of the control's screen: along a lathe's X
/// as a radius.
PositionChange shown_change(const PositionToShow& shown);

}  // namespace dripline::gateway
