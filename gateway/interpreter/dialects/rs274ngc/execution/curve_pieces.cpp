#include "gateway/interpreter/dialects/rs274ngc/execution/splines.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dripline::interpreter::rs274ngc {
namespace {

constexpr int kMaxHalvings = 10;
/// Between the places that are looked at a curve may lie a little farther out.
constexpr double kMargin = 0.9;

/// Of a point from the straight line through two others.
double distance_from_chord(PlaneVector point, PlaneVector begin, PlaneVector end) {
  const double size = distance(begin, end);
  if (size == 0) return distance(point, begin);
  return std::fabs(cross(end - begin, point - begin)) / size;
}

class Flattening {
 public:
  Flattening(const Curve& curve, double tolerance, std::vector<PlaneVector>& points)
      : curve_(curve), tolerance_(tolerance * kMargin), points_(points) {}

  void add(double from, PlaneVector begin, double to, PlaneVector end, int halvings) {
    const double middle = (from + to) / 2;
    const PlaneVector half = curve_(middle);
    if (halvings == kMaxHalvings ||
        (is_near(half, begin, end) && is_near(curve_((from + middle) / 2), begin, end) &&
         is_near(curve_((middle + to) / 2), begin, end))) {
      points_.push_back(end);
      return;
    }
    add(from, begin, middle, half, halvings + 1);
    add(middle, half, to, end, halvings + 1);
  }

 private:
  bool is_near(PlaneVector point, PlaneVector begin, PlaneVector end) const {
    return distance_from_chord(point, begin, end) <= tolerance_;
  }

  const Curve& curve_;
  double tolerance_;
  std::vector<PlaneVector>& points_;
};

double length_of(PlaneVector from, const std::vector<PlaneVector>& points) {
  double total = 0;
  for (const PlaneVector& point : points) total += distance(std::exchange(from, point), point);
  return total;
}

}  // namespace

void add_pieces(const Curve& curve, double from, double to, double tolerance,
                std::vector<PlaneVector>& points) {
  Flattening(curve, tolerance, points).add(from, curve(from), to, curve(to), 0);
}

bool follow_points(Run& run, const std::vector<PlaneVector>& points, const Feed& feed) {
  const bool is_finite = std::all_of(points.begin(), points.end(), [](const PlaneVector& point) {
    return std::isfinite(point.first) && std::isfinite(point.second);
  });
  if (!is_finite) return run.fail(ErrorCode::NotFinite, 0, "a point of the curve");
  Target target;
  target.to = run.state.position;
  target.named = static_cast<AxisBits>(bit_of(Axis::X) | bit_of(Axis::Y));
  PlaneVector from{run.state[Axis::X], run.state[Axis::Y]};
  const double total = length_of(from, points);
  for (const PlaneVector& point : points) {
    const double piece = distance(from, point);
    target.to[index_of(Axis::X)] = point.first;
    target.to[index_of(Axis::Y)] = point.second;
    const bool is_timed = feed.per() == Feed::Per::Move && piece > 0;
    line_to(run, target,
            is_timed ? Feed::inverse_time(feed.moves_per_minute() * total / piece) : feed,
            &point == &points.back() && run.rests_at_end());
    from = point;
  }
  return true;
}

}  // namespace dripline::interpreter::rs274ngc
