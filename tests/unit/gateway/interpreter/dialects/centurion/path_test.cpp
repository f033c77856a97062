#include <cmath>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/dialects/centurion/compensation/tangents.hpp"
#include "tests/unit/gateway/interpreter/dialects/centurion/program_run.hpp"

/// A path besides its points: exact stops, limits of the moves that wait, options.

namespace dripline::interpreter::centurion {

namespace {

constexpr Beside kSides[] = {Beside::Left, Beside::Right};
const PlaneCircle kFirst{{1, -2}, 1.5};
const PlaneCircle kSecond{{7, 3}, 2.5};

double side_of(PlaneVector point) {
  return cross(kSecond.center - kFirst.center, point - kFirst.center);
}
bool is_on(Beside side, PlaneVector point, PlaneVector center) {
  const double turn = cross(kSecond.center - kFirst.center, point - center);
  return (turn > 0) == (side == Beside::Left);
}

// CEN-179
TEST(Tangents, ALineIsTangentToBothCirclesOnTheGivenSides) {
  for (const Beside first : kSides) {
    for (const Beside second : kSides) {
      const auto points = tangent_points(TangentLine{kFirst, kSecond, first, second});
      ASSERT_TRUE(points);
      const PlaneVector line = points->on_second - points->on_first;
      const PlaneVector out = points->on_first - kFirst.center;
      const PlaneVector other = points->on_second - kSecond.center;
      EXPECT_NEAR(length(out), kFirst.radius, 1e-12);
      EXPECT_NEAR(length(other), kSecond.radius, 1e-12);
      EXPECT_NEAR(dot(line, out), 0, 1e-12);
      EXPECT_NEAR(dot(line, other), 0, 1e-12);
      EXPECT_TRUE(is_on(first, points->on_first, kFirst.center));
      EXPECT_TRUE(is_on(second, points->on_second, kSecond.center));
    }
  }
}

// CEN-180
TEST(Tangents, AnArcIsTangentToBothCirclesOnTheGivenSides) {
  constexpr double kRadius = 9;
  for (const Beside first : kSides) {
    for (const Beside second : kSides) {
      for (const Beside center : kSides) {
        const auto points =
            tangent_points(TangentArc{kFirst, kSecond, first, second, center, kRadius});
        ASSERT_TRUE(points);
        EXPECT_NEAR(length(points->on_first - kFirst.center), kFirst.radius, 1e-12);
        EXPECT_NEAR(length(points->on_second - kSecond.center), kSecond.radius, 1e-12);
        EXPECT_NEAR(length(points->on_first - points->center), kRadius, 1e-12);
        EXPECT_NEAR(length(points->on_second - points->center), kRadius, 1e-12);
        EXPECT_EQ(side_of(points->center) > 0, center == Beside::Left);
        EXPECT_TRUE(is_on(first, points->on_first, kFirst.center));
        EXPECT_TRUE(is_on(second, points->on_second, kSecond.center));
      }
    }
  }
}

TEST(Tangents, ImpossibleTangentsHaveNoResult) {
  const PlaneCircle inside{{0, 0}, 1};
  const PlaneCircle around{{0.5, 0}, 5};
  EXPECT_FALSE(tangent_points(TangentLine{inside, around, Beside::Left, Beside::Left}));
  EXPECT_FALSE(tangent_points(TangentLine{inside, inside, Beside::Left, Beside::Left}));
  EXPECT_FALSE(
      tangent_points(TangentArc{kFirst, kSecond, Beside::Left, Beside::Left, Beside::Left, 0.5}))
      << "does not reach";
  EXPECT_FALSE(circle_through({{0, 0}, {1, 1}, {3, 3}}));
  EXPECT_FALSE(circle_through({{0, 0}, {0, 0}, {3, 3}}));
}

// CEN-181
TEST(Tangents, ACircleGoesThroughThreePoints) {
  const auto found = circle_through({{5, 1}, {4, 2}, {3, 1}});
  ASSERT_TRUE(found);
  EXPECT_NEAR(length(found->circle.center - PlaneVector{4, 1}), 0, 1e-12);
  EXPECT_NEAR(found->circle.radius, 1, 1e-12);
  EXPECT_TRUE(found->is_counterclockwise);
  EXPECT_FALSE(circle_through({{3, 1}, {4, 2}, {5, 1}})->is_counterclockwise);
}

/// For each cutting move, whether the axes stop at its end: `r`, or continue: `-`.
class Rests final : public EventSink {
 public:
  void on_line(const Line& event) override { marks += event.rests ? 'r' : '-'; }
  void on_arc(const Arc& event) override { marks += event.rests ? 'r' : '-'; }
  void on_alarm(const Alarm& event) override { marks += event.diagnostic.id; }
  std::string marks;
};

std::string rests_of(const std::string& text, const Setup& setup = {}) {
  MemorySource source(text);
  Rests sink;
  auto run = kCenturionDialect.make(setup, source, sink);
  while ((*run)->step(1000) == StepState::Ran) {
  }
  return sink.marks;
}

/// The feeds of the cutting moves, in program units per minute.
class Feeds final : public EventSink {
 public:
  void on_line(const Line& event) override { add(event.feed); }
  void on_arc(const Arc& event) override { add(event.feed); }
  std::string text;

 private:
  void add(const Feed& feed) { text += fmt::format("{:.3f} ", feed.length().inch()); }
};

std::string feeds_of(const std::string& text, const Setup& setup) {
  MemorySource source(text);
  Feeds sink;
  auto run = kCenturionDialect.make(setup, source, sink);
  while ((*run)->step(1000) == StepState::Ran) {
  }
  return sink.text;
}

Setup with_nose(double inches) {
  Setup setup;
  ToolRecord& tool = setup.tools.emplace_back();
  tool.number = 1;
  tool.radius = Length::inch(inches);
  return setup;
}

Result<Setup> read(std::string_view toml) {
  return parse_setup(toml, Units::Inch);
}
std::string refusal(std::string_view toml) {
  auto setup = read(toml);
  if (!setup) return setup.error().what;
  MemorySource source("M2\n");
  Rests sink;
  auto made = kCenturionDialect.make(*setup, source, sink);
  return made ? "" : made.error().what;
}

// CEN-055: G9 is of its block alone
TEST(CenturionPath, ExactStopOfOneBlock) {
  EXPECT_EQ(rests_of("G98 F9\nX1\nG9 X2\nX3\nG9 G2 X4 Z1 R1\nG1 X5\n"), "-r-r-");
}

// CEN-057, CEN-059
TEST(CenturionPath, ExactStopModeLastsUntilCuttingOrTappingMode) {
  EXPECT_EQ(rests_of("G98 F9\nX1\nG61\nX2\nG0 Z1\nG1 Z2\nG64 X3\nG61 X4\nG63 X5\nX6\n"), "-rr-r--");
}

// CEN-057: the stop is at the compensated corner
TEST(CenturionPath, ExactStopsStayWithCompensatedMoves) {
  EXPECT_EQ(rests_of("T0101 M6\nG98 F9\nG42 X2 Z1\nZ0\nG9 Z-1\nX3\nG61 X4 Z-2\nG40 X6\n",
                     with_nose(0.05)),
            "--r-rr");
}

// CEN-058: the mode as programs read it
TEST(CenturionPath, TappingModeIsShown) {
  ProgramRun run("PRINT [#324]\nG63\nPRINT [#324]\nG64\nPRINT [#324]\n");
  while (run.step() == StepState::Ran) {
  }
  EXPECT_EQ(run.printed(), (std::vector<std::string>{"0.0000", "1.0000", "0.0000"}));
}

TEST(CenturionPath, TooManyEventsBetweenCompensatedMovesAreRefused) {
  std::string text = "T0101 M6\nG98 F9\nG42 X2 Z1\nZ0\nZ-1\n";
  for (int i = 0; i < 140; ++i) text += "M8\nM9\n";
  EXPECT_EQ(rests_of(text + "X3\n", with_nose(0.05)), "--CEN1021");
}

// CEN-193 to CEN-195: words that exclude each other
TEST(CenturionPath, TransformationsRefuseContradictingWords) {
  const auto alarm_of = [](const char* block) {
    ProgramRun run(std::string(block) + "\n");
    while (run.step() == StepState::Ran) {
    }
    return run.alarm().substr(0, 7);
  };
  EXPECT_EQ(alarm_of("G511"), "CEN0518");
  EXPECT_EQ(alarm_of("G551 X0"), "CEN0517");
  EXPECT_EQ(alarm_of("G551 P1000"), "CEN0517");
  EXPECT_EQ(alarm_of("G551 X2 P2"), "CEN0518");
  EXPECT_EQ(alarm_of("G568 AA30 R30"), "CEN0529");
  EXPECT_EQ(alarm_of("G551 X-1\nG41 G1 X1 F1"), "CEN0518");
  EXPECT_EQ(alarm_of("G551 X3 Z1\nG98 F1\nG2 X8 Z0 R4"), "CEN0505");
  EXPECT_EQ(alarm_of("G30 P5 X0"), "CEN0542");
  EXPECT_EQ(alarm_of("G53 G2 X1 Z1"), "CEN0518");
}

// CEN-053
TEST(CenturionPath, FeedPerMinuteFollowsTheSlowestAxis) {
  auto setup = read("[control]\nmaximum_feed = { X = 6.0, Z = 8.0 }\n");
  ASSERT_TRUE(setup);
  // 3 in X (radius) and 4 in Z: 5 along the path, so 6 of X is 10
  EXPECT_EQ(feeds_of("G98 F40\nX6 Z4\nF9 X0 Z0\nF40 Z1\nG2 X2 Z2 R1\n", *setup),
            "10.000 9.000 8.000 6.000 ");
}

TEST(CenturionPath, OptionErrorsNameTheOption) {
  EXPECT_EQ(refusal("[control]\nreference = [ {X=1.0}, {X=1.0}, {X=1.0}, {X=1.0}, {X=1.0} ]\n"),
            "[control] reference: 5 points, this control has 4");
  EXPECT_EQ(refusal("[control]\nspindle_ranges = [ 500, 1000 ]\n"),
            "[control] spindle_ranges: expected low, medium and high");
  EXPECT_EQ(refusal("[control]\nspindle_ranges = [ 500, 1000, 99999 ]\n"),
            "[control] spindle_ranges: 99999 is not 1 to 9999");
  EXPECT_NE(refusal("[control]\nhome = { Y = 1.0 }\n").find("home"), std::string::npos);
  EXPECT_EQ(refusal("[control]\ntool_change = 0\nreference = 0\n"), "");
}

}  // namespace

}  // namespace dripline::interpreter::centurion
