#include "gateway/interpreter/core/path_feed.hpp"

#include <gtest/gtest.h>

#include "gateway/interpreter/stages/dry_run.hpp"

namespace dripline::interpreter {
namespace {

constexpr double kClose = 1e-9;

Position at(double x, double c) {
  Position position;
  position.set(Axis::X, Length::mm(x));
  position.set(Axis::C, Angle::degrees(c));
  return position;
}
Feed per_minute(double value) {
  return Feed::per_minute(Length::mm(value));
}

/// The manual's own figures: 20 mm and 40 degrees at F300 take 0.14907 min.
TEST(FeedOfAllAxes, CountsDegreesAsLengths) {
  const AxisTravel travel = travel_between(at(10, 0), at(30, 40));
  EXPECT_EQ(travel.linear, 20);
  EXPECT_EQ(travel.rotary, 40);
  const Feed feed = feed_of_all_axes(per_minute(300), travel, Length::mm(1));
  EXPECT_NEAR(20 / feed.length().mm(), 0.14907, 1e-5);
  const Feed turned =
      feed_of_all_axes(Feed::per_revolution(Length::mm(0.5)), {3, 4}, Length::mm(1));
  EXPECT_EQ(turned.per(), Feed::Per::Revolution);
  EXPECT_NEAR(turned.length().mm(), 0.3, kClose);
}

TEST(FeedOfAllAxes, CountsDegreesAsInches) {
  const Length inch = Length::inch(1);
  const Feed feed = Feed::per_minute(Length::inch(10));
  EXPECT_NEAR(feed_of_all_axes(feed, {0, 90}, inch).length().mm(), 10, kClose);
  EXPECT_NEAR(feed_of_all_axes(feed, {25.4 * 3, 4}, inch).length().inch(), 6, kClose);
}

TEST(FeedOfAllAxes, LeavesOtherMovesAndInverseTime) {
  EXPECT_EQ(feed_of_all_axes(per_minute(300), {20, 0}, Length::inch(1)), per_minute(300));
  const Feed timed = Feed::inverse_time(2);
  EXPECT_EQ(feed_of_all_axes(timed, {20, 40}, Length::mm(1)), timed);
}

TEST(FeedAlongCircle, GivesTheOtherAxisItsShare) {
  Arc arc;
  arc.to = at(10, 0);
  arc.sweep = Angle::degrees(360);
  EXPECT_EQ(feed_along_circle(per_minute(100), arc, at(10, 0)), per_minute(100));
  arc.to.set(Axis::Z, Length::mm(-50));
  const Feed feed = feed_along_circle(per_minute(100), arc, at(10, 0));
  const double helix = std::hypot(20 * Angle::kPi, 50);
  EXPECT_NEAR(helix / feed.length().mm() * 60, 37.699, 1e-3) << "seconds";
  EXPECT_NEAR(circle_feed_of(feed, arc, at(10, 0)).length().mm(), 100, kClose);
}

/// Keeps the feed of the last line.
struct LastLine final : EventSink {
  void on_line(const Line& event) override { feed = event.feed; }
  Feed feed;
};

TEST(DryRunStage, FeedsAllAxesTogether) {
  LastLine sink;
  DryRun stage(sink, per_minute(1000), true, at(10, 0));
  stage.on_line({{}, at(13, 4), per_minute(5)});
  EXPECT_NEAR(sink.feed.length().mm(), 600, kClose);
  stage.on_rapid({{}, at(0, 90)});
  stage.on_line({{}, at(30, 90), per_minute(5)});
  EXPECT_NEAR(sink.feed.length().mm(), 1000, kClose);
  stage.on_line({{}, at(30, 0), per_minute(5)});
  EXPECT_NEAR(sink.feed.length().mm(), 1000, kClose) << "degrees";
}

}  // namespace
}  // namespace dripline::interpreter
