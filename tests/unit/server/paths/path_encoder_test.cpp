#include "server/paths/path_encoder.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/server/paths/decoded_path.hpp"

namespace dripline::paths {
namespace {

using interpreter::Axis;
using interpreter::Position;
using paths_test::DecodedPoint;

Position at(double x, double y, double z) {
  Position position;
  position.set(Axis::X, Length::mm(x));
  position.set(Axis::Y, Length::mm(y));
  position.set(Axis::Z, Length::mm(z));
  return position;
}

interpreter::Origin in_line(std::uint64_t line, interpreter::ProgramIndex program = 0) {
  return {.block = line, .offset = line * 10, .line = line, .program = program};
}

std::vector<DecodedPoint> points_of(PathEncoder& encoder) {
  encoder.finish();
  return paths_test::PointReader().read(encoder.take());
}

TEST(PathEncoder, WritesEveryMoveWithItsPlace) {
  PathEncoder encoder(at(1, 2, 3), 0);
  encoder.on_rapid({.origin = in_line(4), .to = at(-0.5, 1000.0004, 1e6)});
  encoder.on_line({.origin = in_line(2), .to = at(0, 0, 0), .feed = {}});
  const std::vector<DecodedPoint> expected{
      {.move = 0, .line = 1, .offset = 0, .at = {1000, 2000, 3000}},
      {.move = 0, .line = 4, .offset = 40, .at = {-500, 1'000'000, 1'000'000'000}},
      {.move = 1, .line = 2, .offset = 20, .at = {0, 0, 0}}};
  EXPECT_EQ(points_of(encoder), expected);
}

TEST(PathEncoder, TakesACalledProgramsMovesToTheCallingBlock) {
  PathEncoder encoder(at(0, 0, 0), 0);
  encoder.on_block_end(in_line(7));
  encoder.on_line({.origin = in_line(3, 1), .to = at(1, 0, 0), .feed = {}});
  EXPECT_EQ(points_of(encoder).back().line, 7);
}

TEST(PathEncoder, FollowsAHelixWithinThePromisedDistance) {
  PathEncoder encoder(at(10, 0, 0), 0);
  encoder.on_arc({.origin = in_line(1),
                  .to = at(0, 10, 5),
                  .center_first = {},
                  .center_second = {},
                  .plane = interpreter::Plane::XY,
                  .turn = interpreter::Turn::Counterclockwise,
                  .sweep = Angle::degrees(450),
                  .feed = {}});
  const auto points = points_of(encoder);
  EXPECT_GT(points.size(), 50U);
  EXPECT_LT(points.size(), 200U);
  for (const auto& point : points) {
    const auto x = static_cast<double>(point.at[0]), y = static_cast<double>(point.at[1]);
    EXPECT_NEAR(std::hypot(x, y), 10'000, 2);
  }
  EXPECT_EQ(points.back().at, (std::array<std::int64_t, 3>{0, 10'000, 5'000}));
  for (std::size_t i = 2; i < points.size(); ++i) EXPECT_GT(points[i].at[2], points[i - 1].at[2]);
}

TEST(PathEncoder, LeavesOutWhatTheToleranceAllowsAndNothingElse) {
  PathEncoder encoder(at(0, 0, 0), 0.1);
  for (int i = 1; i <= 1000; ++i)
    encoder.on_line({.origin = in_line(i), .to = at(i, std::sin(i / 50.0) * 20, 0), .feed = {}});
  const auto points = points_of(encoder);
  EXPECT_LT(points.size(), 200U);
  EXPECT_EQ(points.back().at[0], 1'000'000);
  for (int i = 1; i <= 1000; ++i) {
    const auto after =
        std::ranges::find_if(points, [&](const auto& p) { return p.at[0] >= i * 1000; });
    ASSERT_NE(after, points.end());
    const auto before = after - 1;
    const double part = static_cast<double>(i * 1000 - before->at[0]) /
                        static_cast<double>(after->at[0] - before->at[0]);
    const double y = static_cast<double>(before->at[1]) +
                     part * static_cast<double>(after->at[1] - before->at[1]);
    EXPECT_NEAR(y / 1000, std::sin(i / 50.0) * 20, 0.15) << i;
  }
}

TEST(PathEncoder, KeepsTheEndsOfRapidsAndFeeds) {
  PathEncoder encoder(at(0, 0, 0), 10);
  encoder.on_rapid({.origin = in_line(1), .to = at(1, 0, 0)});
  encoder.on_line({.origin = in_line(2), .to = at(2, 0, 0), .feed = {}});
  encoder.on_rapid({.origin = in_line(3), .to = at(3, 0, 0)});
  const auto points = points_of(encoder);
  ASSERT_EQ(points.size(), 4U);
  EXPECT_EQ(points[1].move, 0);
  EXPECT_EQ(points[2].move, 1);
}

TEST(PathEncoder, NamesToolsWithTheirFirstPoint) {
  PathEncoder encoder(at(0, 0, 0), 0);
  encoder.on_tool({.origin = in_line(2), .number = 5, .offset = {}});
  encoder.on_tool({.origin = in_line(3), .number = 6, .is_preselection = true, .offset = {}});
  encoder.on_line({.origin = in_line(4), .to = at(1, 1, 1), .feed = {}});
  ASSERT_EQ(encoder.tools().size(), 1U);
  EXPECT_EQ(encoder.tools()[0].number, 5);
  EXPECT_EQ(encoder.tools()[0].line, 2U);
  EXPECT_EQ(encoder.tools()[0].point, 1U);
}

TEST(PathEncoder, CountsMovesOfAxesThatItDoesNotShow) {
  PathEncoder encoder(at(0, 0, 0), 0);
  Position turned = at(1, 0, 0);
  turned.set(Axis::A, Angle::degrees(90));
  encoder.on_line({.origin = in_line(1), .to = turned, .feed = {}});
  encoder.on_line({.origin = in_line(2), .to = turned, .feed = {}});
  EXPECT_EQ(encoder.other_axes(), 1U);
}

}  // namespace
}  // namespace dripline::paths
