#include "gateway/interpreter/core/coordinate_frame.hpp"

namespace dripline::interpreter {

CoordinateFrame::Values CoordinateFrame::to_program(const Values& machine) const {
  Values program = base_;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      program[row] += turn_[3 * row + column] * machine[column];
  for (std::size_t i = 3; i < kAxisCount; ++i) program[i] += machine[i];
  return program;
}

}  // namespace dripline::interpreter
