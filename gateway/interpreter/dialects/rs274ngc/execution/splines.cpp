#include "gateway/interpreter/dialects/rs274ngc/execution/splines.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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

namespace {

constexpr std::size_t kMaxPieces = 100'000;

/// A curve between two knots, after de Boor.
class BSpline {
 public:
  explicit BSpline(const Nurbs& nurbs)
      : points_(nurbs.points),
        degree_(nurbs.order - 1),
        spans_(static_cast<int>(nurbs.points.size()) - degree_) {}

  int spans() const { return spans_; }
  int degree() const { return degree_; }

  /// Within the span from knot `span` to the next one.
  PlaneVector at(int span, double u) const {
    std::array<ControlPoint, kMaxOrder> sums;
    for (int j = 0; j <= degree_; ++j) sums[index(j)] = weighted(points_[index(span + j)]);
    for (int round = 1; round <= degree_; ++round) {
      for (int j = degree_; j >= round; --j) {
        const double low = knot(span + j);
        const double part = (u - low) / (knot(span + j + degree_ + 1 - round) - low);
        sums[index(j)] = mix(sums[index(j - 1)], sums[index(j)], part);
      }
    }
    const ControlPoint& sum = sums[index(degree_)];
    return {sum.x / sum.weight, sum.y / sum.weight};
  }

 private:
  static std::size_t index(int value) { return static_cast<std::size_t>(value); }
  static ControlPoint weighted(const ControlPoint& point) {
    return {point.x * point.weight, point.y * point.weight, point.weight};
  }
  static ControlPoint mix(const ControlPoint& a, const ControlPoint& b, double part) {
    return {a.x + (b.x - a.x) * part, a.y + (b.y - a.y) * part,
            a.weight + (b.weight - a.weight) * part};
  }
  /// The first and the last are there `degree + 1` times.
  double knot(int i) const { return std::clamp(i - degree_, 0, spans_); }

  const std::vector<ControlPoint>& points_;
  int degree_;
  int spans_;
};

bool refuse_words(Run& run, char capital, std::string_view why) {
  return run.fail_word(ErrorCode::SplineWords, capital, why);
}

/// X, Y and P of a line; those of the first may say the weight of the start only.
bool check_words(Run& run, bool is_first) {
  const Words& words = run.block.words;
  if (words.has_any(kPolarWords)) return refuse_words(run, '@', "G5.2 takes X and Y");
  if (words.has('X') != words.has('Y')) return refuse_words(run, 'X', "G5.2 needs both X and Y");
  const bool has_point = words.has('X');
  if (!has_point && !is_first) return refuse_words(run, 'P', "G5.2 needs X and Y");
  if (has_point && !words.has('P')) return refuse_words(run, 'X', "a control point needs P");
  if (words.has('P') && !(words['P'] > 0)) {
    return refuse_words(run, 'P', fmt::format("the weight {} is not above 0", words['P']));
  }
  const double order = words.value_or('L', 0);
  if (order <= kMaxOrder) return true;
  return refuse_words(run, 'L', fmt::format("the order {} is above {}", order, kMaxOrder));
}

bool check_feed(Run& run) {
  Feed feed;
  return run.state.modes.feed == FeedMode::InverseTime || read_feed(run, false, feed);
}

bool flatten(Run& run, const BSpline& spline, std::vector<PlaneVector>& points) {
  const double step = 1.0 / spline.degree();  // curves of a high degree turn often
  for (int span = 0; span < spline.spans(); ++span) {
    const Curve curve = [&](double u) { return spline.at(span, u); };
    for (int part = 0; part < spline.degree(); ++part) {
      add_pieces(curve, span + part * step, span + (part + 1) * step, run.options.spline_tolerance,
                 points);
    }
    if (points.size() <= kMaxPieces) continue;
    return run.fail(ErrorCode::SplineWords, 0,
                    fmt::format("the curve takes more than {} pieces", kMaxPieces));
  }
  return true;
}

}  // namespace

bool add_control_point(Run& run) {
  Nurbs& nurbs = run.state.nurbs;
  const Words& words = run.block.words;
  const bool is_first = nurbs.points.empty();
  Target target;
  if (!check_spline(run) || !check_words(run, is_first) || !check_feed(run) ||
      !read_target(run, target)) {
    return false;
  }
  if (nurbs.points.size() + 2 > kMaxControlPoints) {
    return run.fail(ErrorCode::SplineWords, 0,
                    fmt::format("more than {} control points", kMaxControlPoints));
  }
  const double weight = words.value_or('P', 1);
  if (is_first) {
    nurbs.order = kLeastOrder;
    nurbs.points.push_back({run.state[Axis::X], run.state[Axis::Y], words.has('X') ? 1.0 : weight});
  }
  nurbs.order = words.value_or('L', 0) > kLeastOrder ? static_cast<int>(words['L']) : nurbs.order;
  if (words.has('X')) {
    nurbs.points.push_back({target.to[index_of(Axis::X)], target.to[index_of(Axis::Y)], weight});
  }
  return true;
}

bool make_nurbs(Run& run) {
  Nurbs& nurbs = run.state.nurbs;
  if (nurbs.points.empty()) return run.fail(ErrorCode::SplineOpen, 0, "G5.3");
  if (run.block.words.has_any(kAxisWords | kPolarWords)) {
    return run.fail(ErrorCode::SplineWords, 0, "G5.3 takes no axis words");
  }
  const std::size_t count = nurbs.points.size();
  if (count < static_cast<std::size_t>(nurbs.order)) {
    return run.fail(
        ErrorCode::SplineWords, 0,
        fmt::format("{} control points are fewer than the order {}", count, nurbs.order));
  }
  Feed feed;
  if (!check_spline(run) || !read_feed(run, false, feed)) return false;
  std::vector<PlaneVector> points;
  if (!flatten(run, BSpline(nurbs), points)) return false;
  points.back() = {nurbs.points.back().x, nurbs.points.back().y};
  nurbs.points.clear();
  run.block.motion = 800;  // no motion mode stays
  return follow_points(run, points, feed);
}

bool fits_in_nurbs(Run& run) {
  const auto bit = [](GGroup group) { return 1u << static_cast<unsigned>(group); };
  constexpr unsigned kHarmless =
      bit(GGroup::OneShot) | bit(GGroup::Motion) | bit(GGroup::Distance) |
      bit(GGroup::ArcDistance) | bit(GGroup::FeedMode) | bit(GGroup::Units) | bit(GGroup::Lathe) |
      bit(GGroup::Retract) | bit(GGroup::Path) | bit(GGroup::SpindleMode);
  const Block& block = run.block;
  const int motion = block.g(GGroup::Motion);
  const int one_shot = block.g(GGroup::OneShot);
  const bool goes_on = motion == Block::kNone || motion == 52 || motion == 53;
  const bool is_dwell = one_shot == Block::kNone || one_shot == 40;
  if (goes_on && is_dwell && (block.g_groups & ~kHarmless) == 0) return true;
  return run.fail(ErrorCode::SplineOpen, 0, "a curve of G5.2 is open");
}

bool check_nurbs_closed(Run& run) {
  if (run.state.nurbs.points.empty()) return true;
  return run.fail(ErrorCode::SplineOpen, 0, "the program ends within a curve of G5.2");
}

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
