#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <functional>

#include "tests/unit/gateway/interpreter/stages/blending/path.hpp"

namespace dripline::interpreter::blending {
namespace {

using testing::ElementsAre;

using Step = std::function<void(Path&)>;

void send_message(Path& path, std::string_view text) {
  path.blender.on_output({Origin{}, OutputDevice::File, text});
}

TEST(BlendOrder, EventsBetweenTwoMovesStayBetweenThem) {
  Path path;
  path.line(10, 0);
  {
    const std::string text = "DONE";  // must not outlive the call
    send_message(path, text);
  }
  path.misc(8);
  EXPECT_TRUE(path.log.words.empty());
  path.line(10, 10);
  EXPECT_THAT(path.log.words, ElementsAre("move1", "/1", "DONE", "M8", "/2"));
}

TEST(BlendOrder, APieceComesRightAfterItsMove) {
  Path path;
  path.round(1).line(10, 0).misc(8).line(10, 10);
  EXPECT_THAT(path.log.words, ElementsAre("move1", "move1", "/1", "M8", "/2"));
}

TEST(BlendOrder, ABlockOfItsOwnHoldsThePiece) {
  Path path;
  path.line(10, 0).misc(8).round_block(1).line(10, 10).end();
  EXPECT_THAT(path.log.words,
              ElementsAre("move1", "/1", "M8", "/2", "move3", "/3", "move4", "/4", "end"));
}

TEST(BlendOrder, NothingWaitsWhereNothingIsAnnounced) {
  Policy policy;
  policy.every_move_waits = false;
  Path path{policy};
  path.line(10, 0);
  EXPECT_THAT(path.log.words, ElementsAre("move1", "/1"));
  path.round(1).line(20, 0);
  EXPECT_TRUE(path.blender.is_waiting());
  path.line(20, 20);
  EXPECT_FALSE(path.blender.is_waiting());
  expect_moves(path.log, {{{10, 0}}, {{19, 0}}, {{20, 1}, {19, 1}, 90}, {{20, 20}}});
}

TEST(BlendOrder, ARapidMoveEndsTheWait) {
  Path path;
  path.line(10, 0).rapid(20, 0);
  EXPECT_FALSE(path.blender.is_waiting());
  EXPECT_THAT(path.log.words, ElementsAre("move1", "/1", "move2", "/2"));
}

constexpr std::size_t kTooMany = look_ahead::kMaxHeldEvents + 36;

TEST(BlendOrder, WhereThereIsNoRoomAMoveEndsAsProgrammed) {
  Path path;
  path.line(10, 0);
  for (std::size_t i = 0; i < kTooMany; ++i) send_message(path, "row");
  EXPECT_FALSE(path.blender.is_waiting());
  path.line(10, 10).end();
  EXPECT_EQ(path.fault(), std::nullopt);
  EXPECT_EQ(path.log.words.size(), 1 + 1 + kTooMany + 1 + 1 + 1);
}

TEST(BlendOrder, ACornerNeedsRoomForAllItsEvents) {
  Path path;
  path.round(1).line(10, 0);
  for (std::size_t i = 0; i < kTooMany; ++i) send_message(path, "row");
  EXPECT_EQ(path.fault(), FaultKind::TooMuchBetween);
}

TEST(BlendOrder, OffPlaneMovesStayAtTheTrueCorner) {
  Path path;
  path.line(10, 0).aside(5).back(135).line(0, 20).end();
  // the line through (0, 20) at 135 degrees meets Y=0 at (20, 0)
  expect_moves(path.log, {{{20, 0}}, {{20, 0}}, {{0, 20}}});
  EXPECT_EQ(path.log.moves[1].z, 5);
}

/// Everything that a state can hold.
std::vector<Step> script() {
  return {[](Path& p) { p.approximate().line(10, 0); },
          [](Path& p) { send_message(p, "a line with a text"); },
          [](Path& p) {
            p.blender.turn_on(compensation::Cutter{});
            p.blender.turn_off();
            p.blender.on_uncounted_block_end({});
          },
          [](Path& p) { p.aside(-4); },
          [](Path& p) {
            p.blender.on_dwell({Origin{}, 0.5, {}});
            p.blender.on_tool({Origin{}, 4, true, 7, ToolShape{}});
            p.blender.on_message({Origin{}, "LOOK"});
          },
          [](Path& p) {
            p.approximate(5).arc_to({20, 0}, {25, 1}, -170);
          },
          [](Path& p) { p.round(0.5, Feed::per_minute(Length::mm(9))).approximate().line(40, 0); },
          [](Path& p) { p.misc(8); },
          [](Path& p) { p.line(40, 20); },
          [](Path& p) { p.chamfer_block(2); },
          [](Path& p) { p.back(150, Back::Farthest).line(0, 40); },
          [](Path& p) { p.end(); }};
}

TEST(BlendOrder, ARestoredStateContinuesInTheSameManner) {
  const std::vector<Step> steps = script();
  Path whole;
  for (const Step& step : steps) step(whole);
  ASSERT_EQ(whole.fault(), std::nullopt) << describe(*whole.blender.fault());
  for (std::size_t cut = 0; cut <= steps.size(); ++cut) {
    Path parted;
    for (std::size_t i = 0; i < cut; ++i) steps[i](parted);
    const std::vector<std::byte> bytes = parted.blender.state();
    parted.blender.reset({});
    const auto restored = parted.blender.restore(bytes);
    ASSERT_TRUE(restored) << restored.error().what;
    EXPECT_EQ(parted.blender.state(), bytes);
    for (std::size_t i = cut; i < steps.size(); ++i) steps[i](parted);
    EXPECT_EQ(parted.log.words, whole.log.words) << "cut before step " << cut;
    ASSERT_EQ(parted.log.moves.size(), whole.log.moves.size());
    for (std::size_t i = 0; i < whole.log.moves.size(); ++i) {
      EXPECT_EQ(parted.log.moves[i].to, whole.log.moves[i].to);
    }
  }
}

TEST(BlendOrder, ADamagedStateIsRefusedAndChangesNothing) {
  Path path;
  const std::vector<Step> steps = script();
  for (std::size_t i = 0; i < 5; ++i) steps[i](path);
  const std::vector<std::byte> bytes = path.blender.state();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::vector<std::byte> cut(bytes.begin(), bytes.begin() + static_cast<long>(size));
    ASSERT_FALSE(path.blender.restore(cut)) << size << " of " << bytes.size() << " bytes";
  }
  EXPECT_EQ(path.blender.state(), bytes);
}

}  // namespace
}  // namespace dripline::interpreter::blending
