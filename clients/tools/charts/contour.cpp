#include "clients/tools/charts/contour.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "clients/tools/charts/pictures.hpp"

namespace dripline::charts {
namespace {

struct Segment {
  ContourPoint from, direction;  ///< direction has length 1
  double length = 0, along = 0;  ///< along: of the contour before it
};

std::vector<Segment> segments_of(std::span<const ContourPoint> nominal) {
  std::vector<Segment> segments;
  double along = 0;
  for (std::size_t i = 1; i < nominal.size(); ++i) {
    const double u = nominal[i].u - nominal[i - 1].u, v = nominal[i].v - nominal[i - 1].v;
    const double length = std::hypot(u, v);
    if (!(length > 0)) continue;
    segments.push_back({nominal[i - 1], {u / length, v / length}, length, along});
    along += length;
  }
  return segments;
}

ContourDeviation nearest(const std::vector<Segment>& segments, const ContourPoint& point) {
  ContourDeviation best;
  double shortest = std::numeric_limits<double>::infinity();
  for (const Segment& segment : segments) {
    const double u = point.u - segment.from.u, v = point.v - segment.from.v;
    const double at =
        std::clamp(u * segment.direction.u + v * segment.direction.v, 0.0, segment.length);
    const double du = u - at * segment.direction.u, dv = v - at * segment.direction.v;
    const double square = du * du + dv * dv;
    if (square >= shortest) continue;
    shortest = square;
    const double side = segment.direction.u * v - segment.direction.v * u;
    best = {{segment.from.u + at * segment.direction.u, segment.from.v + at * segment.direction.v},
            {-segment.direction.v, segment.direction.u},
            segment.along + at,
            side < 0 ? -std::sqrt(square) : std::sqrt(square)};
  }
  return best;
}

Result<void> check_points(const char* name, std::span<const ContourPoint> points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const double value : {points[i].u, points[i].v}) {
      if (auto good = check_magnitude(fmt::format("{} point {}", name, i + 1), value); !good)
        return good;
    }
  }
  return {};
}

}  // namespace

Result<std::vector<ContourDeviation>> deviations(std::span<const ContourPoint> nominal,
                                                 std::span<const ContourPoint> actual) {
  if (nominal.size() > kMaxContourPoints || actual.size() > kMaxContourPoints) {
    return fail(Errc::LimitExceeded,
                "a contour of {} nominal and {} actual points, at most {} each", nominal.size(),
                actual.size(), kMaxContourPoints);
  }
  if (actual.empty()) return fail(Errc::LimitExceeded, "a contour without actual points");
  if (auto good = check_points("nominal", nominal); !good) return fail(good.error());
  if (auto good = check_points("actual", actual); !good) return fail(good.error());
  const auto segments = segments_of(nominal);
  if (segments.empty()) return fail(Errc::LimitExceeded, "a nominal contour without length");
  std::vector<ContourDeviation> result;
  result.reserve(actual.size());
  for (const ContourPoint& point : actual) result.push_back(nearest(segments, point));
  return result;
}

}  // namespace dripline::charts
