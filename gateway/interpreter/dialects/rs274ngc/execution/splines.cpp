#include "gateway/interpreter/dialects/rs274ngc/execution/splines.hpp"

#include <fmt/core.h>

namespace dripline::interpreter::rs274ngc {
namespace {

/// A cubic curve by its end points and the two points that pull it.
struct Cubic {
  PlaneVector start, first, second, end;

  PlaneVector at(double t) const {
    const double s = 1 - t;
    const auto mix = [&](double PlaneVector::*axis) {
      return s * s * s * start.*axis + 3 * s * s * t * first.*axis + 3 * s * t * t * second.*axis +
             t * t * t * end.*axis;
    };
    return {mix(&PlaneVector::first), mix(&PlaneVector::second)};
  }
};

bool read_cubic(Run& run, Cubic& curve) {
  const Words& words = run.block.words;
  State& state = run.state;
  const bool has_first = words.has('I') && words.has('J');
  if (words.has('I') != words.has('J') || (!has_first && !state.follows_spline) ||
      !words.has('P') || !words.has('Q')) {
    return run.fail(ErrorCode::SplineWords, 0, "G5 needs I and J, P and Q");
  }
  const double i = has_first ? run.mm(words['I']) : state.spline_i;
  const double j = has_first ? run.mm(words['J']) : state.spline_j;
  const double p = run.mm(words['P']);
  const double q = run.mm(words['Q']);
  curve.first = {curve.start.first + i, curve.start.second + j};
  curve.second = {curve.end.first + p, curve.end.second + q};
  state.spline_i = -p;  // the next one continues smoothly
  state.spline_j = -q;
  state.follows_spline = true;
  return true;
}

/// A quadratic curve is the cubic whose two control points lie at two thirds of the distance to its
/// one.
bool read_quadratic(Run& run, Cubic& curve) {
  const Words& words = run.block.words;
  if (!words.has('I') && !words.has('J')) {
    return run.fail(ErrorCode::SplineWords, 0, "G5.1 needs I or J");
  }
  const PlaneVector pull{curve.start.first + run.mm(words.value_or('I', 0)),
                         curve.start.second + run.mm(words.value_or('J', 0))};
  const auto toward = [&](PlaneVector from) {
    return PlaneVector{from.first + (pull.first - from.first) * 2 / 3,
                       from.second + (pull.second - from.second) * 2 / 3};
  };
  curve.first = toward(curve.start);
  curve.second = toward(curve.end);
  return true;
}

}  // namespace

bool check_spline(Run& run) {
  const State& state = run.state;
  if (state.modes.plane != Plane::XY || state.modes.has_tilted_plane) {
    return run.fail(ErrorCode::SplinePlane, 0);
  }
  if (state.compensation.side != Side::Off) {
    return run.fail(ErrorCode::CompNotAllowed, 0, "a spline");
  }
  if (run.block.words.has_any(set_of("ZABCUVW"))) {
    return run.fail(ErrorCode::SplineWords, 0, "splines move X and Y only");
  }
  return true;
}

bool spline_move(Run& run, int g_code) {
  if (!check_spline(run)) return false;
  const State& state = run.state;
  Feed feed;
  Target target;
  if (!read_feed(run, false, feed) || !read_target(run, target)) return false;
  Cubic curve;
  curve.start = {state[Axis::X], state[Axis::Y]};
  curve.end = {target.to[index_of(Axis::X)], target.to[index_of(Axis::Y)]};
  if (!(g_code == 50 ? read_cubic(run, curve) : read_quadratic(run, curve))) return false;
  std::vector<PlaneVector> points;
  add_pieces([&](double t) { return curve.at(t); }, 0, 1, run.options.spline_tolerance, points);
  points.back() = curve.end;
  return follow_points(run, points, feed);
}

}  // namespace dripline::interpreter::rs274ngc
