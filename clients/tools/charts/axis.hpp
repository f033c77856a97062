#pragma once

#include <string>
#include <vector>

#include "clients/tools/charts/canvas.hpp"

namespace dripline::charts {

/// A scale with ticks at multiples of 1, 2 or 5 times a power of ten.
struct Axis {
  double low = 0, high = 1, step = 1;
  int decimals = 0;
  /// Above 0: labels have so many significant digits and an exponent, as decimals would fill the
  /// picture.
  int digits = 0;
  std::vector<double> ticks() const;
  /// With so many digits more than a tick needs.
  std::string label(double value, int more = 0) const;
};

/// A scale over `low` to `high` and a little more, with about `count` ticks. Ends that are equal,
/// or so close that a double cannot tell ticks between them apart, get some room. Always finite.
Axis make_axis(double low, double high, int count);
/// Of whole numbers from `first` to `last`, which lie half a step inside.
Axis make_index_axis(std::size_t first, std::size_t last, int count);

/// A box with two axes: values to places.
struct Plot {
  Box box;
  Axis x, y;
  double place_x(double value) const {
    return box.left + (value - x.low) / (x.high - x.low) * box.width;
  }
  double place_y(double value) const {
    return box.bottom() - (value - y.low) / (y.high - y.low) * box.height;
  }
  Point place(double at_x, double at_y) const { return {place_x(at_x), place_y(at_y)}; }
};

struct AxisTitles {
  std::string x, y;
};

/// Grid, frame, tick labels and titles of both axes. Without a title for x its labels are left out
/// too.
void draw_axes(Canvas& canvas, const Plot& plot, const AxisTitles& titles, double text_size);
/// The room that the labels and the title of the y axis take on its left.
double left_margin(const Axis& y, double text_size);
inline constexpr Pen kLimitPen{kLimit, 1.4, Dash::Dashed};

/// The name and the value of a level, on the right of the plot.
void label_level(Canvas& canvas, const Plot& plot, double value, Color color, std::string_view name,
                 double text_size);
/// Across the plot at `value` of the y axis, with its label. Outside the axis nothing is drawn.
void draw_level(Canvas& canvas, const Plot& plot, double value, const Pen& pen,
                std::string_view name, double text_size);

}  // namespace dripline::charts
