#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/dialects/rs274ngc/turning/contour.hpp"

/// A contour in the frame of its cuts: `first` grows with the cut, `second` out of the work. All
/// four quarters, turning and facing look the same there. Pure; lengths in millimeters.
namespace dripline::interpreter::rs274ngc {

struct ContourPiece {
  PlaneVector from = {};
  PlaneVector to = {};
  PlaneVector center = {};
  bool is_arc = false;
  bool is_counterclockwise = false;  ///< in the frame: a valley, where the cut runs over it
};
using ContourPieces = std::vector<ContourPiece>;

/// Between Z and X and the frame; its own inverse but for the axes' order.
struct CutFrame {
  bool is_facing = false;
  double along_sign = 1;
  double depth_sign = 1;

  PlaneVector in(PlaneVector at) const;
  PlaneVector out(PlaneVector at) const;
  /// An arc that is counterclockwise on one side is clockwise on the other.
  bool is_mirrored() const;
};

/// What LinuxCNC decides by, in units of the program.
struct ContourLimits {
  explicit ContourLimits(double mm_per_unit)
      : same(1e-6 * mm_per_unit),
        shown(1e-4 * mm_per_unit),
        least(1e-3 * mm_per_unit),
        gap(1e-2 * mm_per_unit) {}
  double same;   ///< closer points are one
  double shown;  ///< shorter arcs are passed over
  double least;  ///< shorter pieces are none
  double gap;    ///< along the cut: a wider one is filled by an arc about the corner
};

/// The direction of travel at an end; not of length 1.
PlaneVector direction_at_start(const ContourPiece& piece);
PlaneVector direction_at_end(const ContourPiece& piece);
/// Of a line its length, of an arc its chord or radius, whichever is less.
double size_of(const ContourPiece& piece);
/// Runs on along the cut, an arc within the upper or lower half of its circle.
bool runs_along(const ContourPiece& piece, const ContourLimits& limits);
double distance_to(const ContourPiece& piece, PlaneVector point);
/// The point at a part of the piece, 0 to 1.
PlaneVector point_on(const ContourPiece& piece, double part);
/// Moved to the left of its direction, out of the work.
void move_aside(ContourPiece& piece, double distance);
/// Ends the one and begins the other where they meet. False: they do not.
bool meet(ContourPiece& piece, ContourPiece& next, const ContourLimits& limits);

/// Puts in the fillets and chamfers of `moves`, whose pieces are those after the first. Nothing:
/// the reason why it cannot be.
std::optional<ContourPieces> with_corners(const ContourPieces& pieces,
                                          const std::vector<ContourMove>& moves,
                                          const ContourLimits& limits, std::string_view& why);

/// The contour that keeps `distance` (above 0) off `pieces`.
std::optional<ContourPieces> kept_off(const ContourPieces& pieces, double distance,
                                      const ContourLimits& limits, std::string_view& why);

}  // namespace dripline::interpreter::rs274ngc
