#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <functional>

#include "tests/unit/gateway/interpreter/stages/compensation/contour.hpp"

namespace dripline::interpreter::compensation {
namespace {

using testing::ElementsAre;

using Step = std::function<void(Contour&)>;

Policy patient() {
  Policy policy;
  policy.blocks_without_motion = 3;
  return policy;
}

void send_message(Contour& contour, std::string_view text) {
  contour.compensator.on_output({Origin{}, OutputDevice::File, text});
}

TEST(Order, EventsBetweenTwoMovesStayBetweenThem) {
  Contour contour{patient(), {-10, 0}};
  contour.left(2).line(0, 0).line(10, 0);
  {
    const std::string text = "DONE";  // must not outlive the call
    send_message(contour, text);
  }
  contour.misc(8).empty_block();
  EXPECT_THAT(contour.log.words, ElementsAre("move1", "/1"));
  contour.line(10, 10);
  EXPECT_THAT(contour.log.words,
              ElementsAre("move1", "/1", "move2", "/2", "DONE", "M8", "/3", "/4"));
}

TEST(Order, AMoveIsGivenOutAsSoonAsItIsDecided) {
  Contour contour{Policy{}, {-10, 0}};
  contour.left(2).line(0, 0);
  EXPECT_TRUE(contour.compensator.is_waiting());
  EXPECT_TRUE(contour.log.words.empty());
  contour.line(10, 0).off();
  EXPECT_FALSE(contour.compensator.is_waiting()) << "its end is its own normal";
  EXPECT_THAT(contour.log.words, ElementsAre("move1", "/1", "move2", "/2"));
}

TEST(Order, OneBlockTooManyWithoutMotionEndsTheWait) {
  Contour contour{Policy{}, {-10, 0}};
  contour.left(2).line(0, 0).line(10, 0).misc(8);
  EXPECT_TRUE(contour.compensator.is_waiting());
  contour.misc(9);
  EXPECT_FALSE(contour.compensator.is_waiting());
  EXPECT_THAT(contour.log.words, ElementsAre("move1", "/1", "move2", "/2", "M8", "/3", "M9", "/4"));
}

TEST(Order, StatementsAreNoBlocksWithoutMotion) {
  Contour contour{Policy{}, {-10, 0}};
  contour.left(2).line(0, 0).line(10, 0);
  for (int i = 0; i < 1'000; ++i) contour.statement();
  contour.misc(8).statement();
  EXPECT_TRUE(contour.compensator.is_waiting());
  contour.line(10, 10);
  EXPECT_EQ(contour.fault(), std::nullopt);
  EXPECT_NEAR(contour.log.moves[1].to.first, 8, 1e-9) << "the corner was seen";
  EXPECT_LE(contour.log.words.size(), 2u + look_ahead::kMaxHeldEvents);
  EXPECT_THAT(contour.log.words, testing::IsSupersetOf({"/3", "/4", "/1002", "M8", "/1004"}));
}

/// The number of events decides how many may wait, not the number of blocks they come from.
TEST(Order, EndsOfBlocksTakeNoRoom) {
  Policy policy;
  policy.blocks_without_motion = 1'000;
  for (const std::size_t per_block : {1u, 4u}) {
    Contour contour{policy, {-10, 0}};
    contour.left(2).line(0, 0).line(10, 0);
    for (std::size_t i = 0; i < look_ahead::kMaxHeldEvents; ++i) {
      contour.compensator.on_miscellaneous({Origin{}, 8});
      if (i % per_block == per_block - 1) contour.empty_block().empty_block();
    }
    EXPECT_EQ(contour.fault(), std::nullopt) << per_block;
    EXPECT_TRUE(contour.compensator.is_waiting()) << per_block;
    const std::vector<std::byte> bytes = contour.compensator.state();
    EXPECT_TRUE(contour.compensator.restore(bytes));
    EXPECT_EQ(contour.compensator.state(), bytes);
    contour.compensator.on_miscellaneous({Origin{}, 9});
    EXPECT_EQ(contour.fault(), FaultKind::TooMuchBetween) << per_block;
  }
}

TEST(Order, TheEndOfTheProgramEndsTheWait) {
  Contour contour{Policy{}, {-10, 0}};
  contour.left(2).line(0, 0).line(10, 0);
  contour.compensator.on_end({});
  EXPECT_THAT(contour.log.words, ElementsAre("move1", "/1", "move2", "/2", "end"));
}

/// Everything that a state can hold.
std::vector<Step> script() {
  return {[](Contour& c) { c.left(2).line(0, 0); },
          [](Contour& c) { c.line(20, 0); },
          [](Contour& c) {
            send_message(c, "a line with a text");
            c.misc(8);
          },
          [](Contour& c) { c.aside(-4); },
          [](Contour& c) {
            c.compensator.on_dwell({Origin{}, 0.5, {}});
          },
          [](Contour& c) {
            c.compensator.on_spindle({Origin{}, SpindleState::Clockwise, 900, {}, 4000.0});
          },
          [](Contour& c) {
            c.compensator.on_tool({Origin{}, 4, true, 7});
            c.compensator.on_coolant({Origin{}, true, false});
            c.compensator.on_pin({Origin{}, Axis::B, 3, true, 20.0});
            c.compensator.on_stop({Origin{}, StopKind::Optional});
            c.compensator.on_units({Origin{}, Units::Inch});
            c.compensator.on_open({Origin{}, OutputDevice::Port1, "REPORT"});
            c.compensator.on_open({Origin{}, OutputDevice::Port2, {}});
            c.compensator.on_message({Origin{}, "LOOK"});
            c.compensator.on_close({Origin{}, OutputDevice::Port1});
          },
          [](Contour& c) {
            c.arc({20, -10}, -90);
          },
          [](Contour& c) { c.rapid(30, -30); },
          [](Contour& c) {
            c.compensator.shape_next_corner(OutsideCorner::Arc);
            c.feed = Feed::inverse_time(4);
          },
          [](Contour& c) { c.line(0, -30); },
          [](Contour& c) { c.right(3).line(-30, -40); },
          [](Contour& c) { c.off(); },
          [](Contour& c) { c.aside(50); },
          [](Contour& c) { c.line(-50, -50); }};
}

TEST(Order, ARestoredStateContinuesInTheSameManner) {
  const std::vector<Step> steps = script();
  Contour whole{patient(), {-10, 0}};
  for (const Step& step : steps) step(whole);
  ASSERT_EQ(whole.fault(), std::nullopt);
  for (std::size_t cut = 0; cut <= steps.size(); ++cut) {
    Contour parted{patient(), {-10, 0}};
    for (std::size_t i = 0; i < cut; ++i) steps[i](parted);
    const std::vector<std::byte> bytes = parted.compensator.state();
    parted.compensator.reset({});
    const auto restored = parted.compensator.restore(bytes);
    ASSERT_TRUE(restored) << restored.error().what;
    EXPECT_EQ(parted.compensator.state(), bytes);
    for (std::size_t i = cut; i < steps.size(); ++i) steps[i](parted);
    EXPECT_EQ(parted.log.words, whole.log.words) << "cut before step " << cut;
  }
}

TEST(Order, ADamagedStateIsRefusedAndChangesNothing) {
  Contour contour{patient(), {-10, 0}};
  const std::vector<Step> steps = script();
  for (std::size_t i = 0; i < 7; ++i) steps[i](contour);
  const std::vector<std::byte> bytes = contour.compensator.state();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::vector<std::byte> cut(bytes.begin(), bytes.begin() + static_cast<long>(size));
    ASSERT_FALSE(contour.compensator.restore(cut)) << size << " of " << bytes.size() << " bytes";
  }
  EXPECT_EQ(contour.compensator.state(), bytes);
}

TEST(Order, TheLargestStateKeepsItsBound) {
  Policy policy;
  policy.blocks_without_motion = 1'000;
  Contour contour{policy, {-10, 0}};
  contour.left(2).line(0, 0).line(10, 0);
  const std::string text(100, 'x');
  for (int i = 0; i < 32; ++i) contour.empty_block();
  for (int i = 0; i < 40; ++i) send_message(contour, text);
  for (int i = 0; i < 24; ++i) contour.aside(i + 1.0);
  EXPECT_EQ(contour.fault(), std::nullopt);
  EXPECT_GT(contour.compensator.state().size(), 11'000u);
  EXPECT_LT(contour.compensator.state().size(), look_ahead::kMaxStateBytes);
}

}  // namespace
}  // namespace dripline::interpreter::compensation
