#pragma once

#include <array>
#include <cstdint>

#include "gateway/interpreter/core/event.hpp"

namespace dripline::interpreter {

/// How program coordinates lie on the machine when a block has been executed: datum, shift, ROT,
/// SCL, mirrored axes and CC of a control's screen. For the position display, not for a trace.
/// Millimeters and degrees; index as in kAllAxes. A control fills the members it has, the rest
/// keeps its default.
struct CoordinateFrame {
  using Values = std::array<double, kAxisCount>;

  Values datum{};                        ///< machine coordinates: set by hand, or the work offset
  Values shift{};                        ///< added by the program: cycle 7, G52, G92
  double rotation = 0;                   ///< by the program or the work offset
  double basic_rotation = 0;             ///< that of the workpiece, as probed; not in `rotation`
  std::array<double, 3> scale{1, 1, 1};  ///< X, Y, Z; above 0
  std::array<bool, 3> mirrored{};
  std::array<double, 3> pole{};  ///< program coordinates of X, Y, Z
  std::uint8_t pole_axes = 0;    ///< which of them it has, bit 0 = X; 0: there is no pole

  /// The program coordinates of a machine position, both without tool length.
  Values to_program(const Values& machine) const;

  /// Derives the matrix from the control's own computation, which must be linear and leave all axes
  /// but X, Y and Z unchanged. `program_of` gives the program coordinates of machine coordinates.
  template <class ProgramOf>
  void learn(ProgramOf program_of) {
    constexpr double kFar = 1000;  // millimeters: far apart, cancellation costs fewer digits
    base_ = program_of(Values{});
    for (std::size_t column = 0; column < 3; ++column) {
      Values at{};
      at[column] = kFar;
      const Values moved = program_of(at);
      for (std::size_t row = 0; row < 3; ++row)
        turn_[3 * row + column] = (moved[row] - base_[row]) / kFar;
    }
  }
  /// The same for coordinates that are only shifted.
  void learn_offset(const Values& zero) {
    for (std::size_t i = 0; i < kAxisCount; ++i) base_[i] = -zero[i];
  }

 private:
  Values base_{};  ///< program coordinates of machine zero
  std::array<double, 9> turn_{1, 0, 0, 0, 1, 0, 0, 0, 1};
};

}  // namespace dripline::interpreter
