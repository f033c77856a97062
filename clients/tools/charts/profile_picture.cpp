#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "clients/tools/charts/impl/frame.hpp"

namespace dripline::charts {
namespace {

constexpr double kMaxMagnification = 1e9;

struct Extent {
  double low_u = std::numeric_limits<double>::infinity(), high_u = -low_u;
  double low_v = low_u, high_v = -low_u;
};

Extent extent_of(const std::vector<ContourPoint>& points) {
  Extent extent;
  for (const ContourPoint& point : points) {
    include(extent.low_u, extent.high_u, point.u);
    include(extent.low_v, extent.high_v, point.v);
  }
  return extent;
}

struct Extremes {
  double lowest = 0, highest = 0;
};
Extremes extremes_of(const std::vector<ContourDeviation>& found) {
  const auto [low, high] = std::ranges::minmax_element(
      found, {}, [](const ContourDeviation& point) { return point.deviation; });
  return {low->deviation, high->deviation};
}

/// The largest deviation is drawn as about a fifteenth of the contour's size, by a round factor.
double usual_magnification(const Extent& extent, const Extremes& extremes) {
  const double largest = std::max(std::abs(extremes.lowest), std::abs(extremes.highest));
  const double size = std::max(extent.high_u - extent.low_u, extent.high_v - extent.low_v);
  if (!(largest > size / kMaxMagnification)) return 1;  // none that could be seen
  const double wanted = size / 15 / largest;
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  const double factor = wanted / power >= 5 ? 5 : wanted / power >= 2 ? 2 : 1;
  return std::max(1.0, factor * power);
}

bool is_outside(const ProfilePicture& picture, double deviation) {
  return (picture.lower && deviation < *picture.lower) ||
         (picture.upper && deviation > *picture.upper);
}

/// New ticks between the same ends.
Axis with_ends(const Axis& axis, int count) {
  Axis fresh = make_axis(axis.low, axis.high, count);
  fresh.low = axis.low;
  fresh.high = axis.high;
  return fresh;
}

/// Both axes have one scale, so that a contour keeps its shape; the wider one of the two gets more
/// room.
Plot equal_plot(const Box& area, const Extent& extent, double text) {
  Axis x = make_axis(extent.low_u, extent.high_u, tick_count(area.width, text, 8));
  Axis y = make_axis(extent.low_v, extent.high_v, tick_count(area.height, text, 2.5));
  Plot plot = plot_in(area, x, y, text, 2 * text, true);
  const double per_x = (x.high - x.low) / plot.box.width,
               per_y = (y.high - y.low) / plot.box.height;
  const auto widen = [](Axis& axis, double factor) {
    const double middle = (axis.low + axis.high) / 2, half = (axis.high - axis.low) / 2 * factor;
    axis.low = middle - half;
    axis.high = middle + half;
  };
  if (per_x < per_y) {
    widen(plot.x, per_y / per_x);
  } else {
    widen(plot.y, per_x / per_y);
  }
  plot.x = with_ends(plot.x, tick_count(plot.box.width, text, 8));
  plot.y = with_ends(plot.y, tick_count(plot.box.height, text, 2.5));
  return plot;
}

void draw_contour(Canvas& canvas, const Plot& plot, const ProfilePicture& picture,
                  const std::vector<ContourDeviation>& found, double magnification) {
  std::vector<Point> nominal;
  for (const ContourPoint& point : picture.nominal) nominal.push_back(plot.place(point.u, point.v));
  canvas.polyline(nominal, {kInk, 1.4});
  std::vector<Point> tips;
  for (const ContourDeviation& point : found) {
    const double reach = point.deviation * magnification;
    const Point foot = plot.place(point.foot.u, point.foot.v);
    tips.push_back(
        plot.place(point.foot.u + point.normal.u * reach, point.foot.v + point.normal.v * reach));
    canvas.line(foot, tips.back(), {is_outside(picture, point.deviation) ? kLimit : kData, 0.8});
  }
  canvas.polyline(tips, {kData, 0.8, Dash::Dotted});
  for (std::size_t i = 0; i < tips.size(); ++i) {
    if (!is_outside(picture, found[i].deviation)) continue;
    canvas.circle(tips[i], 3, kLimit, {kInk, 1});
  }
}

void draw_along(Canvas& canvas, const Plot& plot, const ProfilePicture& picture,
                const std::vector<ContourDeviation>& found, double text) {
  canvas.line(plot.place(plot.x.low, 0), plot.place(plot.x.high, 0), {kCenter, 1.2});
  if (picture.upper) draw_level(canvas, plot, *picture.upper, kLimitPen, "upper", text);
  if (picture.lower) draw_level(canvas, plot, *picture.lower, kLimitPen, "lower", text);
  std::vector<Point> points;
  for (const ContourDeviation& point : found)
    points.push_back(plot.place(point.along, point.deviation));
  std::ranges::stable_sort(points, {}, &Point::x);
  canvas.polyline(points, {kData, 1});
  for (const ContourDeviation& point : found) {
    const Point at = plot.place(point.along, point.deviation);
    if (is_outside(picture, point.deviation)) {
      canvas.circle(at, 3, kLimit, {kInk, 1});
    } else {
      canvas.circle(at, 1.4, kData, {kData, 0.5});
    }
  }
}

Result<void> check_numbers(const ProfilePicture& picture) {
  if (picture.lower) {
    if (auto good = check_magnitude("the lower limit", *picture.lower); !good) return good;
  }
  if (picture.upper) {
    if (auto good = check_magnitude("the upper limit", *picture.upper); !good) return good;
  }
  const double magnification = picture.magnification.value_or(1);
  if (magnification > 0 && magnification <= kMaxMagnification) return {};
  return fail(Errc::LimitExceeded, "deviations magnified {:g} times: above 0, at most {:g}",
              magnification, kMaxMagnification);
}

std::vector<std::string> notes_of(const ProfilePicture& picture,
                                  const std::vector<ContourDeviation>& found,
                                  const Extremes& extremes, double magnification,
                                  const std::string& unit) {
  const auto outside = std::ranges::count_if(
      found, [&](const ContourDeviation& point) { return is_outside(picture, point.deviation); });
  std::vector<std::string> notes{fmt::format("{} points, deviation {:+.4f} to {:+.4f} {}",
                                             found.size(), extremes.lowest, extremes.highest, unit),
                                 fmt::format("drawn {:g} times as large", magnification)};
  notes.push_back(picture.lower || picture.upper
                      ? fmt::format("{} points outside the limits", outside)
                      : std::string("No limits are given."));
  return notes;
}

}  // namespace

Result<void> draw_profile(Canvas& canvas, const ProfilePicture& picture, const Caption& caption) {
  if (auto good = check_numbers(picture); !good) return good;
  const auto found = deviations(picture.nominal, picture.actual);
  if (!found) return fail(found.error());
  Extent extent = extent_of(picture.nominal);
  const Extremes extremes = extremes_of(*found);
  const double magnification =
      picture.magnification.value_or(usual_magnification(extent, extremes));
  for (const ContourDeviation& point : *found) {
    const double reach = point.deviation * magnification;
    include(extent.low_u, extent.high_u, point.foot.u + point.normal.u * reach);
    include(extent.low_v, extent.high_v, point.foot.v + point.normal.v * reach);
  }
  const Frame frame =
      draw_frame(canvas, caption, notes_of(picture, *found, extremes, magnification, caption.unit));
  const double text = frame.text;
  Box above = frame.inside;
  above.height = frame.inside.height * 0.62 - text;
  const Plot contour = equal_plot(above, extent, text);
  draw_axes(
      canvas, contour,
      {with_unit(picture.first_axis, caption.unit), with_unit(picture.second_axis, caption.unit)},
      text);
  draw_contour(canvas, contour, picture, *found, magnification);
  double low = std::min(0.0, extremes.lowest), high = std::max(0.0, extremes.highest);
  if (picture.lower) include(low, high, *picture.lower);
  if (picture.upper) include(low, high, *picture.upper);
  double longest = 0;
  for (const ContourDeviation& point : *found) longest = std::max(longest, point.along);
  Box below = frame.inside;
  below.top = above.bottom() + text;
  below.height = frame.inside.bottom() - below.top;
  const Axis y = make_axis(low, high, tick_count(below.height, text, 3));
  const double right = text_width("upper +" + y.label(high, 1), text) + 8;
  const Plot along =
      plot_in(below, make_axis(0, longest, tick_count(below.width, text, 8)), y, text, right, true);
  draw_axes(canvas, along,
            {with_unit("along the contour", caption.unit), with_unit("deviation", caption.unit)},
            text);
  draw_along(canvas, along, picture, *found, text);
  return {};
}

}  // namespace dripline::charts
