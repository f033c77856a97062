#include "tests/unit/gateway/interpreter/dialects/tnc155/milled_path.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "clients/tools/offline/offline_run.hpp"
#include "gateway/interpreter/core/geometry/arc_point.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"

namespace dripline::interpreter {
namespace {

constexpr double kSame = 1e-4;

class PointSink final : public EventSink {
 public:
  PointSink(MilledPath& path, unsigned from_line) : path_(path), from_line_(from_line) {}

  void on_rapid(const Rapid& move) override { straight(move.origin, move.to, true); }
  void on_line(const Line& move) override { straight(move.origin, move.to, false); }
  void on_arc(const Arc& arc) override {
    const int pieces = std::max(1, static_cast<int>(arc.sweep.degrees() / 3));
    for (int n = 1; n <= pieces; ++n) {
      Position at = point_on_arc(arc, at_, arc.sweep.degrees() * n / pieces);
      if (n == pieces) at = arc.to;
      add(arc.origin, at, false, n == 1);
    }
    at_ = arc.to;
  }
  void on_alarm(const Alarm& alarm) override { path_.alarm = alarm.diagnostic.text; }

 private:
  void straight(const Origin& origin, const Position& to, bool is_rapid) {
    constexpr double kStep = 0.4;
    double travel = 0;
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
      travel = std::max(travel, std::fabs(to.raw(axis) - at_.raw(axis)));
    const int pieces = std::clamp(static_cast<int>(travel / kStep), 1, 400);
    for (int n = 1; n <= pieces; ++n) {
      Position at = to;
      for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
        at.set_raw(axis, at_.raw(axis) + (to.raw(axis) - at_.raw(axis)) * n / pieces);
      add(origin, at, is_rapid, n == 1);
    }
    at_ = to;
  }
  void add(const Origin& origin, const Position& at, bool is_rapid, bool is_new) {
    if (origin.line < from_line_) return;
    path_.points.push_back({{at.raw(Axis::X), at.raw(Axis::Y)}, at.raw(Axis::Z), is_rapid, is_new});
  }
  MilledPath& path_;
  unsigned from_line_;
  Position at_;
};

PlaneVector along(double degrees) {
  const double angle = degrees * (Angle::kPi / 180);
  return {std::cos(angle), std::sin(angle)};
}
double length_of(PlaneVector v) {
  return std::hypot(v.first, v.second);
}
double scalar(PlaneVector a, PlaneVector b) {
  return a.first * b.first + a.second * b.second;
}
PlaneVector in_frame(PlaneVector point, PlaneVector center, double angle) {
  const PlaneVector by = point - center, u = along(angle);
  return {scalar(by, u), scalar(by, {-u.second, u.first})};
}
double from_wall(const MilledRegion& region, PlaneVector point) {
  double best = -1e9;
  for (const auto& figure : region.figures) best = std::max(best, figure(point));
  return best;
}

/// In the material: no nearer to the wall than the tool's radius and the allowance, and no deeper
/// than an infeed at once; rapid moves go down no further than the clearance.
void expect_within(const MilledPath& path, const MilledRegion& region) {
  const double least = region.tool + region.allowance;
  double deepest = region.surface, before = path.points.front().height;
  for (const MilledPoint& point : path.points) {
    ASSERT_GE(point.height, region.bottom - kSame);
    if (point.height < region.surface - kSame) {
      ASSERT_GE(from_wall(region, point.at), least - kSame)
          << point.at.first << " " << point.at.second << " " << point.height;
    }
    if (point.is_rapid && point.height < region.clearance - kSame) {
      ASSERT_GE(point.height, before - kSame) << "rapid down below the clearance";
    }
    if (region.infeed > 0) {
      ASSERT_LE(deepest - point.height, region.infeed + kSame) << "more than an infeed at once";
      deepest = std::min(deepest, point.height);
    }
    before = point.height;
  }
}

/// Along the wall, where the inside is on one side of it alone.
void expect_direction(const MilledPath& path, const MilledRegion& region) {
  const double least = region.tool + region.allowance;
  const auto is_along = [&](const MilledPoint& point) {
    return !point.is_rapid && point.height < region.surface - kSame &&
           std::fabs(from_wall(region, point.at) - least) < kSame;
  };
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const MilledPoint &before = path.points[i - 1], &point = path.points[i];
    const PlaneVector by = point.at - before.at;
    const double size = length_of(by);
    if (!is_along(point) || !is_along(before) || size < 0.01) continue;
    const PlaneVector middle = 0.5 * (point.at + before.at);
    const PlaneVector left = (0.05 / size) * PlaneVector{-by.second, by.first};
    const double gain = from_wall(region, middle + left) - from_wall(region, middle - left);
    if (std::fabs(gain) < 0.02) continue;
    ASSERT_EQ(gain > 0, region.is_counterclockwise) << "direction along the wall";
  }
}

/// What the tool can reach is cut to the bottom.
void expect_cleared(const MilledPath& path, const MilledRegion& region, std::mt19937& random) {
  const double half = region.width / 2;
  for (int i = 0; i < 60; ++i) {
    const PlaneVector center =
        region.middle + PlaneVector{between(random, -half, half), between(random, -half, half)};
    if (from_wall(region, center) < region.tool + region.allowance) continue;
    const PlaneVector material =
        center + (between(random, 0, 0.999) * region.tool) * along(between(random, 0, 360));
    double nearest = 1e9;
    for (const MilledPoint& point : path.points) {
      if (point.is_rapid || point.height > region.bottom + kSame) continue;
      nearest = std::min(nearest, length_of(point.at - material));
    }
    ASSERT_LE(nearest, region.tool + 0.02) << material.first << " " << material.second;
  }
}

/// A rapid move within the workpiece passes only what was cut as deep before.
void expect_free_rapids(const MilledPath& path, const MilledRegion& region) {
  for (auto point = path.points.begin(); point != path.points.end(); ++point) {
    if (!point->is_rapid || point->height >= region.surface || !point->is_new_move) continue;
    for (int n = 0; n < 4; ++n) {
      const PlaneVector edge = point->at + (0.98 * region.tool) * along(90 * n + 17);
      const bool is_free = std::any_of(path.points.begin(), point, [&](const MilledPoint& cut) {
        return !cut.is_rapid && cut.height <= point->height + kSame &&
               length_of(cut.at - edge) <= region.tool + 0.02;
      });
      ASSERT_TRUE(is_free) << "rapid through what is not cut yet";
    }
  }
}

}  // namespace

MilledPath mill(const std::string& program, const std::string& setup, unsigned from_line) {
  MilledPath path;
  const auto read = parse_setup(setup);
  EXPECT_TRUE(read) << read.error().what;
  if (!read) return path;
  MemorySource source(program);
  PointSink sink(path, from_line);
  const auto outcome = run_offline(**find_dialect("itnc"), *read, source, sink);
  EXPECT_TRUE(outcome) << outcome.error().what;
  return path;
}

WallDistance rectangle_wall(PlaneVector center, double angle, PlaneVector sides, double corner) {
  return [=](PlaneVector point) {
    const PlaneVector at = in_frame(point, center, angle);
    const double a = std::fabs(at.first) - (sides.first / 2 - corner);
    const double b = std::fabs(at.second) - (sides.second / 2 - corner);
    return corner -
           (std::hypot(std::max(a, 0.0), std::max(b, 0.0)) + std::min(std::max(a, b), 0.0));
  };
}
WallDistance round_wall(PlaneVector center, double diameter) {
  return [=](PlaneVector point) { return diameter / 2 - length_of(point - center); };
}
WallDistance slot_wall(PlaneVector center, double angle, double length, double width) {
  return [=](PlaneVector point) {
    PlaneVector at = in_frame(point, center, angle);
    const double half = (length - width) / 2;
    at.first -= std::clamp(at.first, -half, half);
    return width / 2 - length_of(at);
  };
}
WallDistance round_slot_wall(PlaneVector center, double radius, double angle, double span,
                             double width) {
  return [=](PlaneVector point) {
    const PlaneVector by = point - center;
    double at = std::atan2(by.second, by.first) * (180 / Angle::kPi) - angle;
    at -= 360 * std::floor(at / 360);
    double off = std::fabs(length_of(by) - radius);
    if (at > span) {
      off = std::min(length_of(by - radius * along(angle)),
                     length_of(by - radius * along(angle + span)));
    }
    return width / 2 - off;
  };
}

void expect_region(const MilledPath& path, const MilledRegion& region, std::mt19937& random) {
  ASSERT_EQ(path.alarm, "");
  ASSERT_FALSE(path.points.empty());
  ASSERT_NO_FATAL_FAILURE(expect_within(path, region));
  if (!region.is_as_wide_as_tool) {
    ASSERT_NO_FATAL_FAILURE(expect_direction(path, region));
  }
  ASSERT_NO_FATAL_FAILURE(expect_cleared(path, region, random));
  ASSERT_NO_FATAL_FAILURE(expect_free_rapids(path, region));
}

double between(std::mt19937& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random()) / 4294967295.0);
}
int one_of(std::mt19937& random, int count) {
  return static_cast<int>(random() % static_cast<unsigned>(count));
}
double tenths(double value) {
  return std::round(value * 10) / 10;
}

}  // namespace dripline::interpreter
