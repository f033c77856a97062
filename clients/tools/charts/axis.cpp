#include "clients/tools/charts/axis.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "clients/tools/statistics/histogram.hpp"

namespace dripline::charts {
namespace {

constexpr int kMaxDecimals = 9;
constexpr double kMaxPlain = 1e9;  ///< from here labels have an exponent
/// Shorter than this, relative to its place or at 0, no axis is.
constexpr double kLeastRelative = 1e-9, kLeastLength = 1e-30;
constexpr double kWidest = 1e300;

struct Ends {
  double low = 0, high = 0;
};

double bounded(double value) {
  return std::isnan(value) ? 0 : std::clamp(value, -kWidest, kWidest);
}

Ends separate_ends(double low, double high) {
  const double magnitude = std::max(std::abs(low), std::abs(high));
  const double least = std::max(magnitude * kLeastRelative, kLeastLength);
  if (high - low >= least) return {low, high};
  double room = least;
  if (!(high > low)) room = low == 0 ? 1 : std::max(std::abs(low) * 1e-3, kLeastLength);
  const double middle = low / 2 + high / 2;
  return {middle - room, middle + room};
}

}  // namespace

std::vector<double> Axis::ticks() const {
  std::vector<double> values;
  const double slack = step * 1e-6;
  for (double n = std::ceil((low - slack) / step); n * step <= high + slack; ++n) {
    values.push_back(n * step);
  }
  return values;
}

std::string Axis::label(double value, int more) const {
  const double rounded = std::abs(value) < step * 1e-6 ? 0 : value;  // no -0
  return digits > 0 ? fmt::format("{:.{}g}", rounded, digits + more)
                    : fmt::format("{:.{}f}", rounded, decimals + more);
}

Axis make_axis(double low, double high, int count) {
  const Ends ends = separate_ends(bounded(low), bounded(high));
  low = ends.low;
  high = ends.high;
  Axis axis;
  const double room = (high - low) * 0.04;
  axis.low = low - room;
  axis.high = high + room;
  axis.step = statistics::round_step((axis.high - axis.low) / std::max(1, count));
  const int decimals = static_cast<int>(std::ceil(-std::log10(axis.step) - 1e-9));
  const double magnitude = std::max(std::abs(axis.low), std::abs(axis.high));
  axis.decimals = std::clamp(decimals, 0, kMaxDecimals);
  if (decimals > kMaxDecimals || magnitude >= kMaxPlain) {
    axis.digits = 1 + std::max(1, static_cast<int>(std::ceil(std::log10(magnitude / axis.step))));
  }
  return axis;
}

Axis make_index_axis(std::size_t first, std::size_t last, int count) {
  Axis axis;
  axis.low = static_cast<double>(first) - 0.5;
  axis.high = static_cast<double>(std::max(first, last)) + 0.5;
  axis.step = std::max(1.0, statistics::round_step((axis.high - axis.low) / std::max(1, count)));
  return axis;
}

double left_margin(const Axis& y, double text_size) {
  double widest = 0;
  for (const double tick : y.ticks())
    widest = std::max(widest, text_width(y.label(tick), text_size));
  return widest + 2.6 * text_size;
}

void draw_axes(Canvas& canvas, const Plot& plot, const AxisTitles& titles, double text_size) {
  const Box& box = plot.box;
  const Pen grid{kGrid, 1};
  for (const double tick : plot.y.ticks()) {
    const double y = plot.place_y(tick);
    canvas.line({box.left, y}, {box.right(), y}, grid);
    canvas.line({box.left - 4, y}, {box.left, y}, {});
    canvas.text({box.left - 7, y + text_size * 0.35}, plot.y.label(tick), {text_size, Anchor::End});
  }
  for (const double tick : plot.x.ticks()) {
    const double x = plot.place_x(tick);
    canvas.line({x, box.top}, {x, box.bottom()}, grid);
    canvas.line({x, box.bottom()}, {x, box.bottom() + 4}, {});
    if (!titles.x.empty()) {
      canvas.text({x, box.bottom() + 5 + text_size}, plot.x.label(tick),
                  {text_size, Anchor::Middle});
    }
  }
  const Point frame[]{{box.left, box.top}, {box.left, box.bottom()}, {box.right(), box.bottom()}};
  canvas.polyline(frame, {});
  if (!titles.x.empty()) {
    canvas.text({box.left + box.width / 2, box.bottom() + 8 + 2.3 * text_size}, titles.x,
                {text_size, Anchor::Middle});
  }
  canvas.text(
      {box.left - left_margin(plot.y, text_size) + 1.1 * text_size, box.top + box.height / 2},
      titles.y, {text_size, Anchor::Middle, false, true});
}

void label_level(Canvas& canvas, const Plot& plot, double value, Color color, std::string_view name,
                 double text_size) {
  canvas.text({plot.box.right() + 5, plot.place_y(value) + text_size * 0.35},
              fmt::format("{} {}", name, plot.y.label(value, 1)),
              {text_size, Anchor::Start, false, false, color});
}

void draw_level(Canvas& canvas, const Plot& plot, double value, const Pen& pen,
                std::string_view name, double text_size) {
  if (value < plot.y.low || value > plot.y.high) return;
  const double y = plot.place_y(value);
  canvas.line({plot.box.left, y}, {plot.box.right(), y}, pen);
  label_level(canvas, plot, value, pen.color, name, text_size);
}

}  // namespace dripline::charts
