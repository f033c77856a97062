#include <gtest/gtest.h>
#include <algorithm>
#include <map>
#include <random>

#include "tests/unit/gateway/interpreter/stages/compensation/contour.hpp"

/// Over many contours of lines and arcs: the tool keeps its distance from the programmed element it
/// belongs to, and comes no nearer to any other. Fixed seeds.
namespace dripline::interpreter::compensation {
namespace {

constexpr double kExact = 1e-9;  // of the radius, or of the coordinates where those are larger
constexpr int kSamples = 24;
const double kPi = Angle::kPi;

/// A programmed element and how far a point is from it.
struct Drawn {
  PlaneVector from, to, center;
  double sweep = 0;  ///< 0: a line

  double radius() const { return length(from - center); }
  /// From the element prolonged: its line or its circle.
  double from_curve(PlaneVector at) const {
    if (sweep != 0) return std::fabs(length(at - center) - radius());
    const PlaneVector along = (1 / length(to - from)) * (to - from);
    return std::fabs(cross(along, at - from));
  }
  double from_itself(PlaneVector at) const {
    return std::min(
        {is_beside(at) ? from_curve(at) : HUGE_VAL, length(at - from), length(at - to)});
  }
  bool is_beside(PlaneVector at) const {
    if (sweep == 0) return dot(at - from, to - from) > 0 && dot(at - to, from - to) > 0;
    double turn = turn_between(from - center, at - center);
    if (turn * sweep < 0) turn += std::copysign(2 * kPi, sweep);
    return std::fabs(turn) < std::fabs(sweep);
  }
};

PlaneVector along(const Move& move, double part) {
  if (move.kind != Move::Kind::Arc) return move.from + part * (move.to - move.from);
  const PlaneVector out = move.from - move.center;
  const double turn = part * move.sweep;
  return move.center + std::cos(turn) * out + std::sin(turn) * left_of(out);
}

/// A contour drawn from `start` in direction `heading` (radians).
class Pen {
 public:
  Pen(PlaneVector start, double heading) : at_(start), heading_(heading) {}
  void turn(double angle) { heading_ += angle; }
  void line(double size) {
    const PlaneVector to = at_ + size * PlaneVector{std::cos(heading_), std::sin(heading_)};
    drawn.push_back({at_, to, {}, 0});
    at_ = to;
  }
  void arc(double radius, double sweep) {
    const double side = sweep > 0 ? 1 : -1;
    const PlaneVector direction{std::cos(heading_), std::sin(heading_)};
    const PlaneVector center = at_ + side * radius * left_of(direction);
    const PlaneVector out = at_ - center;
    const PlaneVector to = center + std::cos(sweep) * out + std::sin(sweep) * left_of(out);
    drawn.push_back({at_, to, center, sweep});
    at_ = to;
    heading_ += sweep;
  }
  double heading() const { return heading_; }
  PlaneVector at() const { return at_; }
  std::vector<Drawn> drawn;

 private:
  PlaneVector at_;
  double heading_;
};

struct Cut {
  Policy policy;
  Side side = Side::Left;
  double radius = 1;
};

/// Elements `i` become blocks `i + 2`; block 1 is the start-up move.
void cut(Contour& contour, const std::vector<Drawn>& drawn, const Cut& how) {
  contour.on(how.side, how.radius).line(drawn[0].from.first, drawn[0].from.second);
  for (const Drawn& one : drawn) {
    if (one.sweep == 0) {
      contour.line(one.to.first, one.to.second);
    } else {
      contour.arc(one.center, Angle::radians(one.sweep).degrees());
    }
  }
  contour.compensator.flush();
}

double scale(const Drawn& one, double radius) {
  return std::max({radius, length(one.from), length(one.to), length(one.center)});
}

/// The last move of each block lies on the offset of its element; what was inserted before it is
/// never nearer to the corner than the radius.
void expect_offset(const Contour& contour, const std::vector<Drawn>& drawn, double radius) {
  const auto& moves = contour.log.moves;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const std::size_t block = moves[i].origin.block;
    if (block < 2 || length(moves[i].to - moves[i].from) < 1e-6) continue;
    const Drawn& element = drawn[block - 2];
    const double near = kExact * scale(element, radius);
    const bool is_element = i + 1 == moves.size() || moves[i + 1].origin.block != block;
    for (int s = 0; s <= kSamples; ++s) {
      const PlaneVector at = along(moves[i], static_cast<double>(s) / kSamples);
      if (is_element) {
        ASSERT_NEAR(element.from_curve(at), radius, near) << "block " << block;
      } else {
        ASSERT_GE(length(at - element.from), radius - near) << "before block " << block;
      }
    }
  }
}

void expect_no_gouge(const Contour& contour, const std::vector<Drawn>& drawn, double radius) {
  for (const Move& move : contour.log.moves) {
    if (move.origin.block < 2) continue;
    for (int s = 0; s <= kSamples; ++s) {
      const PlaneVector at = along(move, static_cast<double>(s) / kSamples);
      for (const Drawn& one : drawn) {
        ASSERT_GE(one.from_itself(at), radius - 1e-8 * scale(one, radius))
            << "block " << move.origin.block;
      }
    }
  }
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  bool toss() { return between(0, 1) < 0.5; }
  int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(engine_); }

 private:
  std::mt19937_64 engine_;
};

/// Goes on to the right with corners of up to 120 degrees, every element much larger than the
/// cutter (radius 1): no control could gouge it.
std::vector<Drawn> roomy_contour(Random& random) {
  constexpr double kSteepest = 60.0 / 180 * Angle::kPi;
  Pen pen({random.between(-100, 100), random.between(-100, 100)}, 0);
  for (int i = 0; i < 12; ++i) {
    if (random.below(4) > 0) pen.turn(random.between(-kSteepest, kSteepest) - pen.heading());
    if (random.toss()) {
      pen.line(random.between(8, 40));
      continue;
    }
    const double sweep = random.between(-kSteepest, kSteepest) - pen.heading();
    const double radius = random.between(8, 60);
    if (std::fabs(sweep) * radius < 8) {
      pen.line(random.between(8, 40));
    } else {
      pen.arc(radius, sweep);
    }
  }
  return pen.drawn;
}

Cut any_cut(Random& random) {
  Cut how;
  how.policy.outside = random.toss() ? OutsideCorner::Arc : OutsideCorner::ExtendTangents;
  how.side = random.toss() ? Side::Left : Side::Right;
  return how;
}

TEST(Distance, RoomyContoursAreCutWithoutGouge) {
  Random random(20'260'701);
  for (int i = 0; i < 400 && !testing::Test::HasFailure(); ++i) {
    const std::vector<Drawn> drawn = roomy_contour(random);
    const Cut how = any_cut(random);
    Contour contour{how.policy, drawn[0].from + PlaneVector{-20, 3}};
    cut(contour, drawn, how);
    ASSERT_EQ(contour.fault(), std::nullopt) << "contour " << i;
    expect_offset(contour, drawn, how.radius);
    expect_no_gouge(contour, drawn, how.radius);
  }
}

/// Elements of any size and corners of any angle: many cannot be cut. What was given out until the
/// fault was right all the same.
TEST(Distance, WhateverIsGivenOutLiesOnTheOffset) {
  Random random(7);
  int finished = 0;
  for (int i = 0; i < 4'000 && !testing::Test::HasFailure(); ++i) {
    Pen pen({random.between(-1, 1), random.between(-1, 1)}, random.between(0, 6));
    for (int n = 0; n < 6; ++n) {
      pen.turn(random.below(3) == 0 ? 0 : random.between(-kPi, kPi));
      const double size = std::pow(10, random.between(-4, 3));
      if (random.toss()) {
        pen.line(size);
      } else {
        pen.arc(size, random.between(-6, 6));
      }
    }
    Cut how = any_cut(random);
    how.radius = std::pow(10, random.between(-2, 1));
    Contour contour{how.policy, pen.drawn[0].from + PlaneVector{-20, 3}};
    cut(contour, pen.drawn, how);
    finished += !contour.fault();
    expect_offset(contour, pen.drawn, how.radius);
  }
  EXPECT_GT(finished, 200);
}

/// A ring of lines and bulged edges about the origin, back to its start in the middle of an edge.
std::vector<Drawn> ring(Random& random) {
  const int corners = 3 + random.below(9);
  std::vector<PlaneVector> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * kPi * (i + random.between(-0.2, 0.2)) / corners;
    points.push_back(random.between(80, 120) * PlaneVector{std::cos(angle), std::sin(angle)});
  }
  const PlaneVector start = 0.5 * (points.back() + points.front());
  std::vector<Drawn> drawn{{start, points[0], {}, 0}};
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const PlaneVector chord = points[i + 1] - points[i];
    const double bulge = random.toss() ? 0 : random.between(-0.6, 0.6);
    if (bulge == 0) {
      drawn.push_back({points[i], points[i + 1], {}, 0});
      continue;
    }
    const double rise = 0.5 / std::tan(bulge / 2);
    const PlaneVector center = points[i] + 0.5 * chord + rise * left_of(chord);
    drawn.push_back({points[i], points[i + 1], center, bulge});
  }
  drawn.push_back({points.back(), start, {}, 0});
  return drawn;
}

TEST(Distance, ClosedContoursCloseOnBothSides) {
  Random random(99);
  for (int i = 0; i < 400 && !testing::Test::HasFailure(); ++i) {
    const std::vector<Drawn> drawn = ring(random);
    Cut how = any_cut(random);
    how.radius = random.between(0.1, 3);
    Contour contour{how.policy, drawn[0].from + PlaneVector{7, 3}};
    cut(contour, drawn, how);
    ASSERT_EQ(contour.fault(), std::nullopt) << "contour " << i;
    expect_offset(contour, drawn, how.radius);
    expect_no_gouge(contour, drawn, how.radius);
    EXPECT_LT(length(contour.log.moves[0].to - contour.log.at), 1e-9);
  }
}

/// Joins as post processors write them: tangent up to the last digit of the program.
TEST(Distance, RoundedTangentCornersAreCut) {
  Random random(5);
  for (int i = 0; i < 300 && !testing::Test::HasFailure(); ++i) {
    Pen pen({0, 0}, random.between(-1, 1));
    for (int n = 0; n < 8; ++n) {
      if (n % 2 == 0) {
        pen.line(random.between(5, 50));
      } else {
        pen.arc(random.between(5, 50), random.between(-2, 2));
      }
    }
    const auto rounded = [](PlaneVector at) {
      return PlaneVector{std::round(at.first * 1e3) / 1e3, std::round(at.second * 1e3) / 1e3};
    };
    for (Drawn& one : pen.drawn) {
      one.from = rounded(one.from);
      one.to = rounded(one.to);
      if (one.sweep == 0) continue;
      // the center keeps its distance from the rounded start, as I and J are increments from it
      one.center = one.from + rounded(one.center - one.from);
    }
    const Cut how = any_cut(random);
    Contour contour{how.policy, pen.drawn[0].from + PlaneVector{-20, 3}};
    cut(contour, pen.drawn, how);
    ASSERT_EQ(contour.fault(), std::nullopt) << "contour " << i;
    // the programmed arcs themselves are a rounding step wrong
    for (const Move& move : contour.log.moves) {
      if (move.origin.block < 2) continue;
      for (const Drawn& one : pen.drawn) {
        if (&one != &pen.drawn[move.origin.block - 2]) continue;
        ASSERT_NEAR(one.from_curve(move.to), how.radius, 5e-3);
      }
    }
  }
}

}  // namespace
}  // namespace dripline::interpreter::compensation
