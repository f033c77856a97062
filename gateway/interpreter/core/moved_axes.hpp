#pragma once

#include "gateway/interpreter/core/event.hpp"

namespace dripline::interpreter {

/// An interpreter whose control keeps its zero while an operator moves the axes between two
/// programs; found by dynamic_cast, because what most keep does not fit another place.
class MovedAxes {
 public:
  virtual ~MovedAxes() = default;
  /// After what begin_next_text has left was restored, before the first block: the axes are at `at`
  /// of the machine, which may be another place than then. The zero and all other modes stay.
  virtual void find_axes(const Position& at) = 0;
};

}  // namespace dripline::interpreter
