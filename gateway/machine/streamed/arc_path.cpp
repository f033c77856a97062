#include "gateway/machine/streamed/arc_path.hpp"

#include <algorithm>
#include <cmath>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::machine::streamed {
namespace {

constexpr double kPi = Angle::kPi;

std::vector<Coordinates> pieces(const ArcPath& path, double count) {
  std::vector<Coordinates> ends;
  const auto whole = static_cast<std::size_t>(std::max(1.0, std::ceil(count)));
  ends.reserve(whole);
  for (std::size_t i = 1; i < whole; ++i)
    ends.push_back(path.at(static_cast<double>(i) / static_cast<double>(whole)));
  ends.push_back(path.to);
  return ends;
}

}  // namespace

double ArcPath::plane_length() const {
  return std::fabs(sweep) * (start_radius + end_radius) / 2;
}

double ArcPath::feed_length() const {
  return length_of_axes(3);
}

double ArcPath::length() const {
  return length_of_axes(kMaxAxes);
}

double ArcPath::length_of_axes(std::size_t count) const {
  double square = plane_length() * plane_length();
  for (std::size_t i = 0; i < count; ++i)
    if (i != first && i != second) square += (to[i] - from[i]) * (to[i] - from[i]);
  return std::sqrt(square);
}

Coordinates ArcPath::at(double part) const {
  Coordinates point;
  for (std::size_t i = 0; i < kMaxAxes; ++i) point[i] = from[i] + (to[i] - from[i]) * part;
  const double angle = start + sweep * part;
  const double radius = start_radius + (end_radius - start_radius) * part;
  point[first] = center_first + radius * std::cos(angle);
  point[second] = center_second + radius * std::sin(angle);
  return point;
}

ArcPath arc_path(const Coordinates& from, const Coordinates& to, const interpreter::Arc& arc) {
  ArcPath path;
  const auto axes = interpreter::axes_of(arc.plane);
  path.first = static_cast<std::size_t>(axes.first);
  path.second = static_cast<std::size_t>(axes.second);
  path.center_first = arc.center_first.mm();
  path.center_second = arc.center_second.mm();
  path.from = from;
  path.to = to;
  const auto angle_of = [&path](const Coordinates& point) {
    return std::atan2(point[path.second] - path.center_second,
                      point[path.first] - path.center_first);
  };
  const auto radius_of = [&path](const Coordinates& point) {
    return std::hypot(point[path.first] - path.center_first,
                      point[path.second] - path.center_second);
  };
  path.start_radius = radius_of(from);
  path.end_radius = radius_of(to);
  path.start = angle_of(from);
  const double end = angle_of(to);
  const auto miss = [&](double sweep) {
    return std::fabs(std::remainder(path.start + sweep - end, 2 * kPi));
  };
  const double radians = arc.sweep.radians();
  const double stated = arc.turn == interpreter::Turn::Counterclockwise ? radians : -radians;
  path.sweep = miss(-stated) + 1e-6 < miss(stated) ? -stated : stated;
  return path;
}

std::vector<Coordinates> arcs(const ArcPath& path, double count) {
  return pieces(path, std::max(count, std::fabs(path.sweep) / kPi) - 1e-6);
}

std::vector<Coordinates> extremes(const ArcPath& path) {
  std::vector<Coordinates> points;
  const double low = std::min(path.start, path.start + path.sweep);
  const double high = std::max(path.start, path.start + path.sweep);
  double angle = std::ceil(low / (kPi / 2)) * (kPi / 2);
  for (int i = 0; i < 4 && angle <= high; ++i, angle += kPi / 2)
    points.push_back(path.at((angle - path.start) / path.sweep));
  return points;
}

std::vector<Coordinates> chords(const ArcPath& path, double deviation) {
  const double radius = std::max(path.start_radius, path.end_radius);
  const double share = std::clamp(1 - deviation / radius, -1.0, 1.0);
  const double angle = std::clamp(2 * std::acos(share), 1e-4, kPi / 4);
  return pieces(path, std::fabs(path.sweep) / angle);
}

}  // namespace dripline::machine::streamed
