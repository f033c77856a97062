#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "clients/tools/charts/impl/frame.hpp"

namespace dripline::charts {
namespace {

using statistics::ControlChart;
using statistics::Panel;

constexpr std::size_t kShownFindings = 1;

std::string count_note(const ControlChart& chart) {
  std::string note = fmt::format("{} values", chart.values);
  if (chart.subgroup > 1) {
    note += fmt::format(" in {} subgroups of {}", chart.values / chart.subgroup, chart.subgroup);
  }
  if (chart.left_out > 0) note += fmt::format(", the last {} fill no subgroup", chart.left_out);
  return note + "; " + statistics::to_text(chart.baseline.origin);
}

std::vector<std::string> notes_of(const ControlChart& chart) {
  std::vector<std::string> notes{count_note(chart)};
  std::size_t findings = 0;
  for (const Panel& panel : chart.panels) {
    for (const auto& violation : panel.violations) {
      if (++findings > kShownFindings) continue;
      notes.push_back(
          fmt::format("{} point {}: {}", panel.name, panel.first + violation.point + 1,
                      panel.name == "CUSUM" || panel.name == "EWMA" || violation.rule == 0
                          ? "beyond its limits"
                          : statistics::describe(violation)));
    }
  }
  if (findings > kShownFindings) {
    notes.push_back(fmt::format("and {} more findings", findings - kShownFindings));
  }
  if (findings == 0) notes.emplace_back("No rule is broken.");
  return notes;
}

Axis y_axis_of(const Panel& panel, double height, double text) {
  double low = panel.center, high = panel.center;
  for (const auto* values : {&panel.points, &panel.lower_points, &panel.lower, &panel.upper}) {
    for (const double value : *values) include(low, high, value);
  }
  return make_axis(low, high, tick_count(height, text, 2.2));
}

/// Limits are drawn as steps, which a constant limit makes one line.
void draw_limit(Canvas& canvas, const Plot& plot, const Panel& panel,
                const std::vector<double>& limit) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < limit.size(); ++i) {
    const auto x = static_cast<double>(panel.first + i + 1);
    const bool is_new = i == 0 || limit[i] != limit[i - 1];
    if (is_new) points.push_back(plot.place(x - 0.5, limit[i]));
    const bool is_last = i + 1 == limit.size() || limit[i + 1] != limit[i];
    if (is_last) points.push_back(plot.place(x + 0.5, limit[i]));
  }
  canvas.polyline(points, kLimitPen);
}

void draw_points(Canvas& canvas, const Plot& plot, const Panel& panel,
                 const std::vector<double>& values, const std::set<std::size_t>& marked) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < values.size(); ++i) {
    points.push_back(plot.place(static_cast<double>(panel.first + i + 1), values[i]));
  }
  canvas.polyline(points, {kData, 1.2});
  const double spacing =
      plot.box.width / static_cast<double>(std::max<std::size_t>(1, values.size()));
  const double radius = std::clamp(spacing * 0.35, 0.8, 3.5);
  for (std::size_t i = 0; i < points.size(); ++i) {
    // A mark differs in size and outline too, not by its color alone.
    if (marked.contains(i)) {
      canvas.circle(points[i], std::max(radius * 1.5, 3.5), kLimit, {kInk, 1.2});
    } else if (radius >= 1) {
      canvas.circle(points[i], radius, kData, {kData, 0.5});
    }
  }
}

/// Of a CUSUM's two rows only the one that is beyond its limit is marked.
std::set<std::size_t> marked_of(const Panel& panel, const std::vector<double>& values) {
  std::set<std::size_t> marked;
  for (const auto& violation : panel.violations) {
    const std::size_t i = violation.point;
    const bool is_beyond = values[i] > panel.upper[i] || values[i] < panel.lower[i];
    if (panel.lower_points.empty() || is_beyond) marked.insert(i);
  }
  return marked;
}

void draw_panel(Canvas& canvas, const Plot& plot, const Panel& panel, double text) {
  canvas.line(plot.place(plot.x.low, panel.center), plot.place(plot.x.high, panel.center),
              {kCenter, 1.2});
  draw_limit(canvas, plot, panel, panel.upper);
  draw_limit(canvas, plot, panel, panel.lower);
  draw_points(canvas, plot, panel, panel.points, marked_of(panel, panel.points));
  if (!panel.lower_points.empty())
    draw_points(canvas, plot, panel, panel.lower_points, marked_of(panel, panel.lower_points));
  if (panel.points.empty()) return;
  const bool is_cusum = panel.name == "CUSUM";
  label_level(canvas, plot, panel.upper.back(), kLimit, is_cusum ? "+h" : "UCL", text);
  label_level(canvas, plot, panel.center, kCenter, "CL", text);
  label_level(canvas, plot, panel.lower.back(), kLimit, is_cusum ? "-h" : "LCL", text);
}

}  // namespace

void draw_control_chart(Canvas& canvas, const ControlChart& chart, const Caption& caption) {
  const Frame frame = draw_frame(canvas, caption, notes_of(chart));
  const double text = frame.text;
  std::size_t last = 1;
  for (const Panel& panel : chart.panels) last = std::max(last, panel.first + panel.points.size());
  double right = 0, left = 0;
  std::vector<Axis> axes;
  for (const Panel& panel : chart.panels) {
    axes.push_back(
        y_axis_of(panel, frame.inside.height / static_cast<double>(chart.panels.size()), text));
    const std::string widest =
        "UCL " + axes.back().label(panel.upper.empty() ? 0 : panel.upper.back(), 1);
    right = std::max(right, text_width(widest, text) + 8);
    left = std::max(left, left_margin(axes.back(), text));
  }
  double top = frame.inside.top;
  for (std::size_t i = 0; i < chart.panels.size(); ++i) {
    const bool is_last = i + 1 == chart.panels.size();
    const double share = chart.panels.size() == 1 ? 1 : i == 0 ? 0.56 : 0.44;
    const double height = frame.inside.height * share - (is_last ? 0 : text);
    const double shift = left - left_margin(axes[i], text);  // panels begin one below the other
    const Box area{frame.inside.left + shift, top, frame.inside.width - shift, height};
    const Axis x = make_index_axis(1, last, tick_count(area.width, text, 5));
    const Plot plot = plot_in(area, x, axes[i], text, right, is_last);
    const std::string unit = caption.unit;
    draw_axes(canvas, plot,
              {is_last ? (chart.subgroup > 1 ? "subgroup" : "value in order of time") : "",
               with_unit(chart.panels[i].name, unit)},
              text);
    draw_panel(canvas, plot, chart.panels[i], text);
    top += height + text;
  }
}

}  // namespace dripline::charts
