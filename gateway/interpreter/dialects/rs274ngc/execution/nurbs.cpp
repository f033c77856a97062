
#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/rs274ngc/execution/splines.hpp"

namespace dripline::interpreter::rs274ngc {
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

}  // namespace dripline::interpreter::rs274ngc
