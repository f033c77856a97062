#pragma once

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"

/// What a cycle of the dialect itnc mills, as points close together: for tests that compare the
/// region that the tool passes with the one that the words of the cycle state.
namespace dripline::interpreter {

struct MilledPoint {
  PlaneVector at;
  double height = 0;
  bool is_rapid = false;
  bool is_new_move = false;  ///< the first one of its move
};

struct MilledPath {
  std::vector<MilledPoint> points;  ///< from the begin of the line `from_line` of the program on
  std::string alarm;                ///< its text; empty: none
};
/// Tool axis Z, coordinates of the machine in millimeters.
MilledPath mill(const std::string& program, const std::string& setup, unsigned from_line);

/// A point's distance from the wall, positive inside; 2D, millimeters.
using WallDistance = std::function<double(PlaneVector)>;
WallDistance rectangle_wall(PlaneVector center, double angle, PlaneVector sides, double corner);
WallDistance round_wall(PlaneVector center, double diameter);
WallDistance slot_wall(PlaneVector center, double angle, double length, double width);
WallDistance round_slot_wall(PlaneVector center, double radius, double angle, double span,
                             double width);

/// What the milling of a region promises.
struct MilledRegion {
  std::vector<WallDistance> figures;
  double tool = 0;  ///< radius
  double surface = 0, bottom = 0, clearance = 0;
  double allowance = 0;  ///< that stays on the wall
  double infeed = 0;     ///< at most from level to level; 0: not looked at
  bool is_counterclockwise = true;
  bool is_as_wide_as_tool = false;  ///< both walls are cut at once, in either direction
  double width = 0;                 ///< of the square around the figures that points are taken from
  PlaneVector middle;
};
/// Reports each promise that the path breaks: nothing beyond the wall, the region cut to its
/// bottom, rapid moves only where it is free, the direction along the wall.
void expect_region(const MilledPath& path, const MilledRegion& region, std::mt19937& random);

double between(std::mt19937& random, double low, double high);
int one_of(std::mt19937& random, int count);
double tenths(double value);

}  // namespace dripline::interpreter
