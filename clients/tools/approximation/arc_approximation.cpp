#include "clients/tools/approximation/arc_approximation.hpp"

#include <cmath>

namespace dripline::interpreter {
namespace {

/// Corners by radius and angle, both relative to the arc.
struct Corner {
  double radius;  ///< mm
  double angle;   ///< radians from the arc's begin, growing
};
using Corners = std::vector<Corner>;

/// Rounded up, but not for what floating point adds to a whole number.
double whole_steps(double count) {
  constexpr double kNoise = 1e-9;
  return std::max(1.0, std::ceil(count - kNoise));
}

struct Task {
  double radius, sweep, tolerance;
};

Corners by_chords(const Task& task, double steps) {
  Corners corners;
  for (double k = 0; k <= steps; ++k) corners.push_back({task.radius, task.sweep * k / steps});
  return corners;
}

/// Half steps first and last, so that begin and end lie on the circle.
Corners by_tangents(const Task& task, double steps) {
  const double step = task.sweep / steps;
  const double outside = task.radius / std::cos(step / 2);
  Corners corners{{task.radius, 0}};
  for (double k = 0; k < steps; ++k) corners.push_back({outside, (k + 0.5) * step});
  corners.push_back({task.radius, task.sweep});
  return corners;
}

/// The first and the last side by the tangent method, those between cut through the circle.
Corners by_secants(const Task& task, double between) {
  const double half_tangent = std::acos(task.radius / (task.radius + task.tolerance));
  const double inner = task.sweep - 2 * half_tangent;
  Corners corners{{task.radius, 0}};
  for (double k = 0; k <= between; ++k) {
    corners.push_back({task.radius + task.tolerance, half_tangent + inner * k / between});
  }
  corners.push_back({task.radius, task.sweep});
  return corners;
}

double chord_angle(const Task& task) {
  return 2 * std::acos((task.radius - task.tolerance) / task.radius);
}
double tangent_angle(const Task& task) {
  return 2 * std::acos(task.radius / (task.radius + task.tolerance));
}
double secant_angle(const Task& task) {
  return 2 * std::acos(task.radius / (task.radius + 2 * task.tolerance));
}

Result<void> check(const ArcToApproximate& arc) {
  const double radius = arc.radius.mm();
  const double tolerance = arc.tolerance.mm();
  if (!(radius > 0)) return fail(Errc::LimitExceeded, "radius: must be above 0");
  if (!(tolerance > 0) || tolerance >= radius / 2) {
    return fail(Errc::LimitExceeded, "tolerance: must be above 0 and below half the radius");
  }
  const double sweep = std::fabs(arc.sweep.degrees());
  if (!(sweep > 0) || sweep > 360) {
    return fail(Errc::LimitExceeded, "sweep: {} degrees are not within 360, or none", sweep);
  }
  return {};
}

}  // namespace

Result<std::vector<PathPoint>> approximate(const ArcToApproximate& arc) {
  if (const auto done = check(arc); !done) return fail(done.error());
  const Task task{arc.radius.mm(), std::fabs(arc.sweep.radians()), arc.tolerance.mm()};
  const double angle = arc.method == ArcMethod::Chord     ? chord_angle(task)
                       : arc.method == ArcMethod::Tangent ? tangent_angle(task)
                                                          : secant_angle(task);
  const double inner =
      arc.method == ArcMethod::Secant ? task.sweep - tangent_angle(task) : task.sweep;
  const double steps = whole_steps(inner / angle);
  if (steps + 3 > static_cast<double>(kMaxApproximationPoints)) {
    return fail(Errc::LimitExceeded, "{:.0f} steps, more than {}", steps, kMaxApproximationPoints);
  }
  Corners corners;
  if (arc.method == ArcMethod::Chord) {
    corners = by_chords(task, steps);
  } else if (arc.method == ArcMethod::Tangent || inner <= 0) {
    corners = by_tangents(task, inner <= 0 ? 1 : steps);
  } else {
    corners = by_secants(task, steps);
  }
  const double sense = arc.sweep.degrees() < 0 ? -1 : 1;
  std::vector<PathPoint> points;
  points.reserve(corners.size());
  for (const Corner& corner : corners) {
    const double at = arc.from.radians() + sense * corner.angle;
    points.push_back({arc.center_x + Length::mm(corner.radius * std::cos(at)),
                      arc.center_y + Length::mm(corner.radius * std::sin(at))});
  }
  return points;
}

}  // namespace dripline::interpreter
