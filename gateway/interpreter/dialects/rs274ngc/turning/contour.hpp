#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/core/language/line_reader.hpp"

/// The contour of LinuxCNC's lathe cycles G70, G71 and G72: a subprogram whose moves are recorded.
namespace dripline::interpreter::rs274ngc {

/// A move of the contour. Points are program coordinates in millimeters, along Z and X.
struct ContourMove {
  PlaneVector to;
  PlaneVector center;
  bool is_arc = false;
  bool is_counterclockwise = false;
  double corner = 0;  ///< A or C: size of the fillet or chamfer at its end; 0: none
  bool is_chamfer = false;
};

inline constexpr std::size_t kMaxContourMoves = 2000;
inline constexpr int kMaxFinishingPasses = 1000;

/// The cycle whose contour is being recorded. Lengths in millimeters.
struct TurningCycle {
  std::int16_t code = 0;     ///< tenths: G71.1 is 711; 0: none
  bool has_warned = false;   ///< of words in the contour that do nothing
  std::uint32_t level = 0;   ///< calls that are open outside of the contour
  TextPlace line;            ///< of the cycle
  PlaneVector start;         ///< where the cycle begins
  double distance = 0;       ///< D: kept off the contour
  double last_distance = 0;  ///< E of G70
  int passes = 1;            ///< P of G70
  double increment = 0;      ///< I
  double retract = 0;        ///< R
  std::vector<ContourMove> moves;
};

}  // namespace dripline::interpreter::rs274ngc
