#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "clients/tools/charts/impl/frame.hpp"
#include "clients/tools/statistics/distributions.hpp"

namespace dripline::charts {
namespace {

using statistics::Capability;
using statistics::Index;

/// Limits that are far wider than the values vary would make a hundred digits.
std::string ratio_text(double value) {
  return std::abs(value) < 1e6 ? fmt::format("{:.2f}", value) : fmt::format("{:.3g}", value);
}

std::string index_text(const char* name, const std::optional<Index>& index) {
  if (!index) return {};
  std::string text = fmt::format("{} {}", name, ratio_text(index->value));
  if (index->interval) {
    text += fmt::format(" ({} to {})", ratio_text(index->interval->low),
                        ratio_text(index->interval->high));
  }
  return text;
}

std::string capability_note(const Capability& capability) {
  std::string note;
  for (const auto& text : {index_text("Cp", capability.cp), index_text("Cpk", capability.cpk),
                           index_text("Pp", capability.pp), index_text("Ppk", capability.ppk)}) {
    if (!text.empty()) note += (note.empty() ? "" : ", ") + text;
  }
  return note;
}

/// No exponent, and digits only where they are known.
std::string ppm_text(double ppm) {
  return ppm >= 10 ? fmt::format("{:.0f}", ppm) : fmt::format("{:.2f}", ppm);
}

std::vector<std::string> notes_of(const HistogramPicture& picture, const Axis& x) {
  const auto& summary = picture.summary;
  std::vector<std::string> notes{
      fmt::format("{} values, mean {}, standard deviation {}, {} to {}", summary.count,
                  x.label(summary.mean, 2), x.label(summary.standard_deviation, 3),
                  x.label(summary.minimum, 1), x.label(summary.maximum, 1))};
  if (const auto& capability = picture.capability) {
    notes.push_back(capability_note(*capability));
    std::string note = fmt::format(
        "{} below and {} above the limits; {} ppm outside expected ({})", capability->below,
        capability->above, ppm_text(capability->expected_outside), to_string(capability->shape));
    if (capability->pp && capability->pp->interval) {
      note += fmt::format(", {:.4g} % confidence", capability->confidence * 100);
    }
    notes.push_back(note);
  }
  return notes;
}

void draw_bars(Canvas& canvas, const Plot& plot, const statistics::Histogram& histogram) {
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    if (histogram.counts[i] == 0) continue;
    const Point low = plot.place(histogram.edge(i), static_cast<double>(histogram.counts[i]));
    const Point high = plot.place(histogram.edge(i + 1), 0);
    canvas.rectangle({low.x, low.y, high.x - low.x, high.y - low.y}, kFill);
    const Point outline[]{{low.x, high.y}, low, {high.x, low.y}, high};
    canvas.polyline(outline, {kData, 1});
  }
}

/// Values a cell that the normal distribution would have.
double normal_count(const HistogramPicture& picture, double value) {
  const auto& summary = picture.summary;
  const double z = (value - summary.mean) / summary.standard_deviation;
  return statistics::normal_density(z) / summary.standard_deviation * picture.histogram.width *
         static_cast<double>(summary.count);
}

/// Of values that hardly vary within a cell the curve would be a needle that flattens the bars.
bool has_curve(const HistogramPicture& picture) {
  return picture.summary.standard_deviation > picture.histogram.width / 20;
}

void draw_curve(Canvas& canvas, const Plot& plot, const HistogramPicture& picture) {
  if (!has_curve(picture)) return;
  constexpr int kPieces = 160;
  std::vector<Point> points;
  for (int i = 0; i <= kPieces; ++i) {
    const double value = plot.x.low + (plot.x.high - plot.x.low) * i / kPieces;
    points.push_back(plot.place(value, normal_count(picture, value)));
  }
  canvas.polyline(points, {kInk, 1.6});
}

struct Mark {
  std::optional<double> value;
  const char* name;
  Color color;
  Dash dash;
};

/// Upright lines, their names above the plot; one that would cover its neighbor's is a line higher.
void draw_marks(Canvas& canvas, const Plot& plot, const HistogramPicture& picture, double text) {
  const Mark marks[]{{picture.tolerance.lower, "lower", kLimit, Dash::Dashed},
                     {picture.nominal, "nominal", kCenter, Dash::Solid},
                     {picture.tolerance.upper, "upper", kLimit, Dash::Dashed}};
  double taken = -1e9;
  for (const Mark& mark : marks) {
    if (!mark.value) continue;
    const double x = plot.place_x(*mark.value);
    canvas.line({x, plot.box.top}, {x, plot.box.bottom()}, {mark.color, 1.6, mark.dash});
    const std::string label = fmt::format("{} {}", mark.name, plot.x.label(*mark.value));
    const double half = text_width(label, text) / 2;
    const bool is_covered = x - half < taken;
    canvas.text({x, plot.box.top - text * (is_covered ? 1.7 : 0.4)}, label,
                {text, Anchor::Middle, false, false, mark.color});
    if (!is_covered) taken = x + half + text * 0.5;
  }
}

}  // namespace

void draw_histogram(Canvas& canvas, const HistogramPicture& picture, const Caption& caption) {
  double low = picture.histogram.origin,
         high = picture.histogram.edge(picture.histogram.counts.size());
  for (const auto& mark : {picture.tolerance.lower, picture.tolerance.upper, picture.nominal}) {
    if (mark) include(low, high, *mark);
  }
  const double rough_text = text_size_of(canvas);
  const Axis x = make_axis(low, high, tick_count(canvas.width(), rough_text, 8));
  const Frame frame = draw_frame(canvas, caption, notes_of(picture, x));
  double most = has_curve(picture) ? normal_count(picture, picture.summary.mean) : 0;
  for (const std::size_t count : picture.histogram.counts)
    most = std::max(most, static_cast<double>(count));
  Axis y = make_axis(0, most, tick_count(frame.inside.height, frame.text, 2.5));
  y.low = 0;
  y.step = std::max(1.0, y.step);
  y.decimals = y.digits = 0;
  Box area = frame.inside;
  area.top += frame.text * 2;  // the names of the limits
  area.height -= frame.text * 2;
  const Plot plot = plot_in(area, x, y, frame.text, frame.text * 2, true);
  draw_axes(canvas, plot, {with_unit("measured value", caption.unit), "values a cell"}, frame.text);
  draw_bars(canvas, plot, picture.histogram);
  draw_curve(canvas, plot, picture);
  draw_marks(canvas, plot, picture, frame.text);
}

}  // namespace dripline::charts
