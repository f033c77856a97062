#include "gateway/interpreter/dialects/rs274ngc/compensation/offset_curves.hpp"

#include <cmath>

namespace dripline::interpreter::rs274ngc {
namespace {

Meeting meet_lines(const OffsetCurve& a, const OffsetCurve& b) {
  constexpr double kParallel = 1e-12;
  const double across = cross(a.along, b.along);
  if (std::fabs(across) < kParallel) return {};
  return {1, {a.at + (cross(b.at - a.at, b.along) / across) * a.along, {}}};
}

Meeting meet_circle(const OffsetCurve& line, const OffsetCurve& circle) {
  // The foot of the center on the line, and half the chord.
  const PlaneVector foot = line.at + dot(circle.at - line.at, line.along) * line.along;
  const double away = length(foot - circle.at);
  if (away > circle.radius) return {};
  const double half = std::sqrt(circle.radius * circle.radius - away * away);
  return {2, {foot + half * line.along, foot - half * line.along}};
}

Meeting meet_circles(const OffsetCurve& a, const OffsetCurve& b) {
  const double apart = length(b.at - a.at);
  if (apart == 0) return {};
  const double foot = (apart * apart + a.radius * a.radius - b.radius * b.radius) / (2 * apart);
  if (std::fabs(foot) > a.radius) return {};
  const double half = std::sqrt(a.radius * a.radius - foot * foot);
  const PlaneVector toward = (1 / apart) * (b.at - a.at);
  const PlaneVector middle = a.at + foot * toward;
  return {2, {middle + half * left_of(toward), middle - half * left_of(toward)}};
}

}  // namespace

Meeting meet(const OffsetCurve& a, const OffsetCurve& b) {
  if (a.is_circle) return b.is_circle ? meet_circles(a, b) : meet_circle(b, a);
  return b.is_circle ? meet_circle(a, b) : meet_lines(a, b);
}

}  // namespace dripline::interpreter::rs274ngc
