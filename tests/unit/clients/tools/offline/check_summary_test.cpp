#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "clients/tools/offline/check_summary.hpp"

namespace dripline::interpreter {

namespace {

Stop stop_at(std::uint64_t offset, StopKind kind, ProgramIndex program = kMainProgram) {
  Stop stop;
  stop.origin.offset = offset;
  stop.origin.program = program;
  stop.kind = kind;
  return stop;
}

TEST(StopList, KeepsPlacesInTheOrderTheyAreMet) {
  StopList list;
  list.on_stop(stop_at(70, StopKind::Program));
  list.on_stop(stop_at(20, StopKind::ToolChange, 1));
  list.on_stop(stop_at(20, StopKind::Program, 2));
  ASSERT_EQ(list.places().size(), 3U);
  EXPECT_EQ(list.places()[0].stop.origin.offset, 70U);
  EXPECT_EQ(list.places()[1].stop.kind, StopKind::ToolChange);
  EXPECT_EQ(list.places()[2].stop.origin.program, 2U);
  EXPECT_EQ(list.count(), 3U);
}

TEST(StopList, CountsAPlaceThatIsMetAgain) {
  StopList list;
  for (int pass = 0; pass < 3; ++pass) {
    list.on_stop(stop_at(20, StopKind::ToolChange));
    list.on_stop(stop_at(20, StopKind::Program));
  }
  ASSERT_EQ(list.places().size(), 2U);
  EXPECT_EQ(list.places()[0].times, 3U);
  EXPECT_EQ(list.places()[1].times, 3U);
  EXPECT_EQ(list.count(), 6U);
}

TEST(StopList, IsBoundedAndCountsOn) {
  StopList list;
  for (std::uint64_t i = 0; i < StopList::kMaxPlaces + 5; ++i) {
    list.on_stop(stop_at(i, StopKind::Program));
  }
  list.on_stop(stop_at(3, StopKind::Program));
  EXPECT_EQ(list.places().size(), StopList::kMaxPlaces);
  EXPECT_EQ(list.places()[3].times, 2U);
  EXPECT_EQ(list.count(), StopList::kMaxPlaces + 6);
}

constexpr double kPi = Angle::kPi;

Position to(double x, double y, double z) {
  Position position;
  position.set(Axis::X, Length::mm(x));
  position.set(Axis::Y, Length::mm(y));
  position.set(Axis::Z, Length::mm(z));
  return position;
}
AxisExtent extent(const Summary& summary, Axis axis) {
  return summary.extents[static_cast<std::size_t>(axis)].value();
}

TEST(CheckSummary, RapidAndFeedAreToldApart) {
  CheckSummary check({}, {Length::mm(6000), 1000});
  check.on_rapid({{}, to(30, 40, 0)});
  check.on_line({{}, to(30, 40, -20), Feed::per_minute(Length::mm(240))});
  const Summary& summary = check.summary();
  EXPECT_DOUBLE_EQ(summary.rapid_length.mm(), 50);
  EXPECT_DOUBLE_EQ(summary.feed_length.mm(), 20);
  EXPECT_DOUBLE_EQ(summary.seconds, 0.5 + 5);
  EXPECT_EQ(summary.moves, 2U);
}

TEST(CheckSummary, FeedPerRevolutionTakesTheSpindle) {
  CheckSummary check;
  check.on_spindle({{}, SpindleState::Clockwise, 600, std::nullopt, std::nullopt});
  check.on_line({{}, to(0, 0, -10), Feed::per_revolution(Length::mm(0.1))});
  EXPECT_DOUBLE_EQ(check.summary().seconds, 10);
}

TEST(CheckSummary, SurfaceSpeedIsLimited) {
  CheckSummary check(to(10, 0, 0));
  check.on_spindle({{}, SpindleState::Clockwise, 0, Length::mm(20 * kPi * 500), std::nullopt});
  check.on_dwell({{}, 0, 500.0});
  EXPECT_NEAR(check.summary().seconds, 60, 1e-9);
  check.on_spindle({{}, SpindleState::Clockwise, 0, Length::mm(20 * kPi * 500), 250.0});
  check.on_dwell({{}, 0, 500.0});
  EXPECT_NEAR(check.summary().seconds, 60 + 120, 1e-9);
}

TEST(CheckSummary, InverseTimeAndDwellCountAsTheySay) {
  CheckSummary check;
  check.on_line({{}, to(1, 0, 0), Feed::inverse_time(2)});
  check.on_dwell({{}, 1.5, std::nullopt});
  EXPECT_DOUBLE_EQ(check.summary().seconds, 31.5);
}

TEST(CheckSummary, ArcsCountTheirPathAndReach) {
  CheckSummary check(to(10, 0, 0));
  // Half a turn from +X over +Y to -X, rising by 5.
  check.on_arc({{},
                to(-10, 0, 5),
                {},
                {},
                Plane::XY,
                Turn::Counterclockwise,
                Angle::degrees(180),
                Feed::per_minute(Length::mm(100))});
  const Summary& summary = check.summary();
  EXPECT_NEAR(summary.feed_length.mm(), std::hypot(10 * kPi, 5), 1e-9);
  EXPECT_NEAR(extent(summary, Axis::Y).most, 10, 1e-9);
  EXPECT_NEAR(extent(summary, Axis::Y).least, 0, 1e-9);
  EXPECT_NEAR(extent(summary, Axis::X).least, -10, 1e-9);
}

TEST(CheckSummary, AClockwiseArcReachesToItsOwnSide) {
  CheckSummary check(to(10, 0, 0));
  check.on_arc(
      {{}, to(-10, 0, 0), {}, {}, Plane::XY, Turn::Clockwise, Angle::degrees(180), Feed{}});
  EXPECT_NEAR(extent(check.summary(), Axis::Y).least, -10, 1e-9);
  EXPECT_NEAR(extent(check.summary(), Axis::Y).most, 0, 1e-9);
}

TEST(CheckSummary, AFullCircleReachesEverywhere) {
  CheckSummary check(to(3, 4, 0));
  check.on_arc({{}, to(3, 4, 0), {}, {}, Plane::XY, Turn::Clockwise, Angle::degrees(360), Feed{}});
  EXPECT_NEAR(extent(check.summary(), Axis::X).most, 5, 1e-9);
  EXPECT_NEAR(extent(check.summary(), Axis::X).least, -5, 1e-9);
  EXPECT_NEAR(extent(check.summary(), Axis::Y).most, 5, 1e-9);
  EXPECT_NEAR(extent(check.summary(), Axis::Y).least, -5, 1e-9);
}

/// Compared with many points along each arc.
TEST(CheckSummary, ArcsOfAnySweepReachAsFarAsTheirPoints) {
  constexpr int kPoints = 2000, kArcs = 500;
  std::mt19937 random(1);  // NOLINT(cert-msc51-cpp,cert-msc32-c): the same arcs each time
  std::uniform_real_distribution<double> angle(0, 2 * kPi), radius(1, 100), place(-50, 50);
  for (int i = 0; i < kArcs; ++i) {
    const double r = radius(random), first = place(random), second = place(random);
    const double begin = angle(random), sweep = i % 7 == 0 ? kPi : angle(random);
    const bool is_left = i % 2 == 0;
    const auto at = [&](double turned) {
      const double now = begin + (is_left ? turned : -turned);
      return to(first + r * std::cos(now), second + r * std::sin(now), 0);
    };
    CheckSummary check(at(0));
    check.on_line({{}, at(0), {}});
    Arc arc;
    arc.to = at(sweep);
    arc.center_first = Length::mm(first);
    arc.center_second = Length::mm(second);
    arc.turn = is_left ? Turn::Counterclockwise : Turn::Clockwise;
    arc.sweep = Angle::radians(sweep);
    check.on_arc(arc);
    CheckSummary points(at(0));
    for (int k = 0; k <= kPoints; ++k) points.on_line({{}, at(sweep * k / kPoints), {}});
    for (const Axis axis : {Axis::X, Axis::Y}) {
      EXPECT_NEAR(extent(check.summary(), axis).least, extent(points.summary(), axis).least, 1e-3);
      EXPECT_NEAR(extent(check.summary(), axis).most, extent(points.summary(), axis).most, 1e-3);
    }
  }
}

TEST(CheckSummary, OnlyMovedAxesHaveAnExtent) {
  CheckSummary check;
  Position only_z;
  only_z.set(Axis::Z, Length::mm(3));
  check.on_rapid({{}, only_z});
  EXPECT_FALSE(check.summary().extents[static_cast<std::size_t>(Axis::X)]);
  EXPECT_DOUBLE_EQ(extent(check.summary(), Axis::Z).least, 3);
}

TEST(CheckSummary, WarningsAreCountedAndBounded) {
  CheckSummary check;
  for (int i = 0; i < 5000; ++i) check.on_warning({{}, {"T1", "again", 1, 0}});
  EXPECT_EQ(check.summary().warning_count, 5000U);
  EXPECT_EQ(check.summary().warnings.size(), Summary::kMaxWarnings);
}

TEST(CheckSummary, EndAndAlarmAreKept) {
  CheckSummary check;
  Origin origin;
  origin.block = 7;
  check.on_block_end(origin);
  EXPECT_EQ(check.summary().blocks, 7U);
  EXPECT_FALSE(check.summary().ended);
  check.on_alarm({origin, {"T2", "bad", 3, 0}});
  EXPECT_EQ(check.summary().alarm->diagnostic.id, "T2");
  check.on_end({origin, 8, true});
  EXPECT_TRUE(check.summary().ended);
  EXPECT_EQ(check.summary().blocks, 8U);
}

}  // namespace

}  // namespace dripline::interpreter
