#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/prototrak/executor.hpp"

/// Pockets and frames of the Executor (README, "Decided here"): clearing rings from the inside out,
/// a rough pass along the wall that leaves the finish cut, and the finish pass.
namespace dripline::interpreter::prototrak {
namespace {

constexpr double kStepOver = 0.75;  ///< of the tool's diameter
/// One event of the control is one block, and a machine queues some 2,000 actions of a block at
/// most.
constexpr std::size_t kMaxCircleRings = 600;
constexpr std::size_t kMaxRectangleRings = 200;

XY middle(const ProgramEvent& event) {
  return {(event.begin.x + event.end.x) / 2, (event.begin.y + event.end.y) / 2};
}

/// How far inside the wall each clearing ring runs, innermost first; the last one is the rough wall
/// pass. Rings follow each other until less than a step is left to the middle. Of a circle that is
/// clear then: the tool comes down in its center.
std::vector<double> ring_offsets(double to_middle, const ProgramEvent& event, std::size_t most) {
  const double step = kStepOver * event.diameter;
  std::vector<double> offsets{event.diameter / 2 + event.finish_cut};
  while (to_middle - offsets.back() >= step && offsets.size() <= most) {
    offsets.push_back(offsets.back() + step);
  }
  std::reverse(offsets.begin(), offsets.end());
  if (event.finish_cut > 0) offsets.push_back(event.diameter / 2);
  return offsets;
}

}  // namespace

/// About `center`; corners of radius `corner`.
struct Executor::Rectangle {
  XY center;
  double half_x = 0, half_y = 0;
  double corner = 0;
};

/// Two half circles, from the top of the circle, where the tool is.
void Executor::run_circle(XY center, double radius, const ProgramEvent& event) {
  if (radius < kNoise) return;
  const XY top{center.x, center.y + radius};
  const XY bottom{center.x, center.y - radius};
  cut({true, top, bottom, center, radius, event.is_counterclockwise}, event.feed);
  cut({true, bottom, top, center, radius, event.is_counterclockwise}, event.feed);
}

/// Once round in the event's direction: from the middle of the top edge, where the tool is, or from
/// the end of the corner at the event's first corner point.
void Executor::run_rectangle(const Rectangle& path, const ProgramEvent& event, bool from_top) {
  const double a = path.half_x, b = path.half_y, c = path.corner;
  const bool ccw = event.is_counterclockwise;
  const auto point = [&](double x, double y) { return XY{path.center.x + x, path.center.y + y}; };
  struct Corner {
    double u, v;
  };
  constexpr Corner kCounterclockwise[] = {{-1, 1}, {-1, -1}, {1, -1}, {1, 1}};
  constexpr Corner kClockwise[] = {{1, 1}, {1, -1}, {-1, -1}, {-1, 1}};
  const Corner* const corners = ccw ? kCounterclockwise : kClockwise;
  int first = 0;
  if (!from_top) {  // begin after the corner at XB, YB
    const double u = event.begin.x < event.end.x ? -1 : 1;
    const double v = event.begin.y < event.end.y ? -1 : 1;
    while (corners[first].u != u || corners[first].v != v) ++first;
    ++first;
  }
  for (int i = 0; i < 4; ++i) {
    const auto [u, v] = corners[(first + i) % 4];
    const XY on_x_side = point(u * a, v * (b - c));
    const XY on_y_side = point(u * (a - c), v * b);
    const bool enters_on_x_side = (u * v > 0) == ccw;
    const XY enter = enters_on_x_side ? on_x_side : on_y_side;
    const XY leave = enters_on_x_side ? on_y_side : on_x_side;
    line(enter, event.feed);
    if (c > kNoise) {
      cut({true, enter, leave, point(u * (a - c), v * (b - c)), c, ccw}, event.feed);
    }
  }
  if (from_top) line(point(0, b), event.feed);
}

bool Executor::clear_circle(const ProgramEvent& event) {
  if (event.diameter <= 0 || event.diameter > 2 * event.radius + kNoise) {
    return fail(Fault::ToolDoesNotFit,
                fmt::format("D {:.4f} in a circle of {:.4f}", event.shown(event.diameter),
                            event.shown(2 * event.radius)));
  }
  const auto offsets = ring_offsets(event.radius, event, kMaxCircleRings);
  if (offsets.size() > kMaxCircleRings) return fail(Fault::ToolDoesNotFit, "more than 600 passes");
  load_tool(event);
  rapid(event.begin);
  wait(StopKind::Operator);
  for (const double offset : offsets) {
    const double radius = std::max(0.0, event.radius - offset);
    line({event.begin.x, event.begin.y + radius}, event.feed);
    run_circle(event.begin, radius, event);
  }
  wait(StopKind::Operator);
  return true;
}

bool Executor::clear_rectangle(const ProgramEvent& event) {
  const double half_x = std::fabs(event.end.x - event.begin.x) / 2;
  const double half_y = std::fabs(event.end.y - event.begin.y) / 2;
  const double shorter = std::min(half_x, half_y);
  if (event.diameter <= 0 || event.diameter > 2 * shorter + kNoise ||
      event.conrad > shorter + kNoise) {
    return fail(Fault::ToolDoesNotFit,
                fmt::format("D {:.4f}, CR {:.4f} in a width of {:.4f}", event.shown(event.diameter),
                            event.shown(event.conrad), event.shown(2 * shorter)));
  }
  auto offsets = ring_offsets(shorter, event, kMaxRectangleRings);
  if (shorter - offsets.front() > event.diameter / 2 + kNoise) {
    offsets.insert(offsets.begin(),
                   shorter);  // else a rib would stay along the longer side's middle
  }
  if (offsets.size() > kMaxRectangleRings) {
    return fail(Fault::ToolDoesNotFit, "more than 200 passes");
  }
  if (event.conrad > 0 && event.conrad < event.diameter / 2) {
    warn(Fault::Noticed, "corners come out with the tool's radius");
  }
  load_tool(event);
  const XY center = middle(event);
  rapid(center);
  wait(StopKind::Operator);
  for (const double offset : offsets) {
    const Rectangle ring{center, std::max(0.0, half_x - offset), std::max(0.0, half_y - offset),
                         std::max(0.0, event.conrad - offset)};
    line({center.x, center.y + ring.half_y}, event.feed);
    run_rectangle(ring, event, true);
  }
  wait(StopKind::Operator);
  return true;
}

/// The tool's side and the direction decide whether it runs inside or outside (manual: events).
bool Executor::run_frame(const ProgramEvent& event) {
  const bool is_circle = event.kind == EventKind::CircularFrame;
  const bool is_on_line = event.side == ToolSide::Center;
  const bool is_inside = (event.side == ToolSide::Left) == event.is_counterclockwise;
  const double half_x = is_circle ? event.radius : std::fabs(event.end.x - event.begin.x) / 2;
  const double half_y = is_circle ? event.radius : std::fabs(event.end.y - event.begin.y) / 2;
  const double shorter = std::min(half_x, half_y);
  const bool fits = is_on_line || !is_inside || event.diameter <= 2 * shorter + kNoise;
  if (!fits || shorter <= 0 || (!is_circle && event.conrad > shorter + kNoise)) {
    return fail(Fault::ToolDoesNotFit,
                fmt::format("D {:.4f}, CR {:.4f} in a width of {:.4f}", event.shown(event.diameter),
                            event.shown(event.conrad), event.shown(2 * shorter)));
  }
  std::vector<double> leaves{0};
  if (event.finish_cut > 0) leaves.insert(leaves.begin(), event.finish_cut);
  load_tool(event);
  bool has_begun = false;
  for (const double left : leaves) {
    const double aside = is_on_line ? 0 : (event.diameter / 2 + left) * (is_inside ? -1 : 1);
    const XY center = is_circle ? event.begin : middle(event);
    const Rectangle path{center, std::max(0.0, half_x + aside), std::max(0.0, half_y + aside),
                         std::max(0.0, event.conrad + aside)};
    const double u = event.begin.x < event.end.x ? -1 : 1;
    const double v = event.begin.y < event.end.y ? -1 : 1;
    const bool leaves_on_y_side = (u * v > 0) == event.is_counterclockwise;
    const XY begin =
        is_circle ? XY{center.x, center.y + path.half_x}
        : leaves_on_y_side
            ? XY{center.x + u * (path.half_x - path.corner), center.y + v * path.half_y}
            : XY{center.x + u * path.half_x, center.y + v * (path.half_y - path.corner)};
    if (has_begun) {
      line(begin, event.feed);
    } else {
      rapid(begin);
      wait(StopKind::Operator);
    }
    has_begun = true;
    is_circle ? run_circle(center, path.half_x, event) : run_rectangle(path, event, false);
    if (is_on_line) break;
  }
  wait(StopKind::Operator);
  return true;
}

}  // namespace dripline::interpreter::prototrak
