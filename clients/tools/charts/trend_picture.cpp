#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "clients/tools/charts/impl/frame.hpp"

namespace dripline::charts {
namespace {

/// Distinct also for people who see no red or no green (Okabe and Ito), on white.
constexpr std::array<Color, 6> kLives{Color{0, 114, 178},  Color{213, 94, 0}, Color{0, 120, 90},
                                      Color{204, 80, 150}, Color{90, 90, 90}, Color{140, 100, 0}};
constexpr std::size_t kNamedLives = 6;

struct Slope {
  double at_zero = 0, per_life = 0;
};
/// Least squares; nothing for fewer than two different places.
std::optional<Slope> slope_of(const std::vector<TrendPoint>& points) {
  const auto n = static_cast<double>(points.size());
  double life = 0, value = 0;
  for (const auto& point : points) {
    life += point.life / n;
    value += point.value / n;
  }
  double squares = 0, products = 0;
  for (const auto& point : points) {
    squares += (point.life - life) * (point.life - life);
    products += (point.life - life) * (point.value - value);
  }
  if (!(squares > 0)) return std::nullopt;
  const double per_life = products / squares;
  return Slope{value - per_life * life, per_life};
}

std::vector<std::string> notes_of(const TrendPicture& picture, const std::string& unit,
                                  const Axis& y) {
  std::size_t count = 0;
  for (const ToolLife& life : picture.lives) count += life.points.size();
  std::vector<std::string> notes{
      fmt::format("{} values of {} tool lives", count, picture.lives.size())};
  double steepest = 0, flattest = 0;
  bool has_slope = false;
  for (const ToolLife& life : picture.lives) {
    const auto slope = slope_of(life.points);
    if (!slope) continue;
    if (!has_slope) steepest = flattest = slope->per_life;
    has_slope = true;
    include(flattest, steepest, slope->per_life);
  }
  if (has_slope) {
    const auto signed_text = [&](double value) {
      return (value < 0 ? "" : "+") + y.label(value * 100, 2);
    };
    notes.push_back(fmt::format("slope {} to {} {} per 100 {}", signed_text(flattest),
                                signed_text(steepest), unit, picture.life_unit));
  }
  return notes;
}

void draw_life(Canvas& canvas, const Plot& plot, const ToolLife& life, Color color) {
  std::vector<Point> points;
  double last = 0;
  for (const auto& point : life.points) {
    points.push_back(plot.place(point.life, point.value));
    last = std::max(last, point.life);
  }
  canvas.polyline(points, {color, 0.8, Dash::Dotted});
  for (const Point& point : points) canvas.circle(point, 2.4, color, {color, 0.5});
  if (const auto slope = slope_of(life.points)) {
    const double first = life.points.front().life;
    canvas.line(plot.place(first, slope->at_zero + first * slope->per_life),
                plot.place(last, slope->at_zero + last * slope->per_life), {color, 1.8});
  }
}

void draw_names(Canvas& canvas, const Box& area, const std::vector<ToolLife>& lives, double text) {
  double x = area.left;
  for (std::size_t i = 0; i < std::min(lives.size(), kNamedLives); ++i) {
    const double width = text_width(lives[i].tool, text) + 2.5 * text;
    if (x + width > area.right()) return;
    canvas.circle({x + text * 0.5, area.top + text * 0.6}, 3.4, kLives[i], {kLives[i], 0.5});
    canvas.text({x + text * 1.2, area.top + text}, lives[i].tool, {text});
    x += width;
  }
}

}  // namespace

void draw_trend(Canvas& canvas, const TrendPicture& picture, const Caption& caption) {
  double low = std::numeric_limits<double>::infinity(), high = -low, longest = 0;
  for (const ToolLife& life : picture.lives) {
    for (const auto& point : life.points) {
      include(low, high, point.value);
      longest = std::max(longest, point.life);
    }
  }
  for (const auto& mark : {picture.tolerance.lower, picture.tolerance.upper, picture.nominal}) {
    if (mark) include(low, high, *mark);
  }
  if (!(low <= high)) low = high = 0;
  const double rough_text = text_size_of(canvas);
  const Axis y = make_axis(low, high, tick_count(canvas.height() * 0.6, rough_text, 2.5));
  const Frame frame = draw_frame(canvas, caption, notes_of(picture, caption.unit, y));
  Axis x = make_axis(0, longest, tick_count(frame.inside.width, frame.text, 6));
  x.low = std::min(0.0, x.low);
  draw_names(canvas, frame.inside, picture.lives, frame.text);
  Box area = frame.inside;
  area.top += frame.text * 2;
  area.height -= frame.text * 2;
  const double right = text_width("nominal " + y.label(high, 1), frame.text) + 8;
  const Plot plot = plot_in(area, x, y, frame.text, right, true);
  draw_axes(canvas, plot, {picture.life_unit, with_unit("measured value", caption.unit)},
            frame.text);
  if (picture.tolerance.upper)
    draw_level(canvas, plot, *picture.tolerance.upper, kLimitPen, "upper", frame.text);
  if (picture.nominal)
    draw_level(canvas, plot, *picture.nominal, {kCenter, 1.2}, "nominal", frame.text);
  if (picture.tolerance.lower)
    draw_level(canvas, plot, *picture.tolerance.lower, kLimitPen, "lower", frame.text);
  for (std::size_t i = 0; i < picture.lives.size(); ++i) {
    draw_life(canvas, plot, picture.lives[i], kLives[i % kLives.size()]);
  }
}

}  // namespace dripline::charts
