#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "clients/tools/measurement_files/source.hpp"

/// Digitized points, as a probe that scans a surface reports them.
namespace dripline::measurement_files {

struct DigitizedPoint {
  double x = 0, y = 0, z = 0;
};

/// What X of measured points is. A lathe's program prints diameters where its control programs
/// them; probe records of its gateway are radii. A contour is one of radii: nothing else is a
/// shape.
enum class PointX : std::uint8_t { Radius, Diameter };
/// "radius", "diameter". Errors: Syntax.
Result<PointX> parse_point_x(std::string_view text);
/// Diameters become radii.
void make_radii(std::vector<DigitizedPoint>& points, PointX x);

/// Of measurements: those of one record whose characteristics end with X, Y and Z are a point. Z
/// may be missing (then 0): a contour in a plane. X is a radius in them, whatever it is in the
/// measurements. Errors: those of the source; NotFound (no measurement is a point), LimitExceeded
/// (over kMaxPoints, a value beyond kMaxPlace).
Result<std::vector<DigitizedPoint>> points_of(MeasurementSource& source, PointX x = PointX::Radius);
inline constexpr std::size_t kMaxPoints = 4'000'000;
inline constexpr double kMaxPlace = 1e9;  ///< mm; a float of an STL has 7 digits

/// Two or three numbers a line, separated by comma, semicolon, tab or space; a first line of names
/// is skipped. Errors: Syntax (with the line), LimitExceeded (over kMaxPoints).
Result<std::vector<DigitizedPoint>> read_points(std::string_view file);

/// x,y,z a line, millimeters.
Result<void> write_points_csv(std::span<const DigitizedPoint> points, const Sink& sink);
/// AutoCAD R12 ASCII, which every CAD program reads: the points on layer POINTS, and a polyline
/// through each pass on layer PASSES. A pass ends where the next point is more than `gap` away; 0:
/// four times the median distance.
Result<void> write_dxf(std::span<const DigitizedPoint> points, double gap, const Sink& sink);

/// Heights over a regular grid, row by row from low y; each the mean of the points in its cell.
struct HeightGrid {
  double x = 0, y = 0;  ///< of the first cell's center
  double cell = 0;
  std::size_t columns = 0, rows = 0;
  std::vector<double> heights;
  std::size_t filled = 0;  ///< cells without a point of their own: the mean of their neighbors'
};
inline constexpr std::size_t kMaxGridCells = 4'000'000;

/// `cell` 0: the median distance of neighboring points. Errors: LimitExceeded (fewer than 4 points,
/// all on a line, over kMaxGridCells, a value beyond kMaxPlace, a large field of which less than
/// one cell in 200 has a point).
Result<HeightGrid> make_height_grid(std::span<const DigitizedPoint> points, double cell);

/// A closed solid: the surface, a flat base `base` below its lowest point, and the sides. Binary
/// STL, millimeters.
Result<void> write_stl(const HeightGrid& grid, double base, const Sink& sink);

}  // namespace dripline::measurement_files
