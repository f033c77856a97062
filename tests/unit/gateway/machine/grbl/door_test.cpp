#include <gtest/gtest.h>

#include "tests/unit/gateway/machine/grbl/grbl_shop.hpp"

namespace dripline::machine::grbl::test {
namespace {

/// A program with the spindle on, whose board was stopped by its safety door. After a cycle start
/// the spindle takes 4 s to come up, in which the board takes no feed hold; then the axes move.
class GrblDoor : public testing::Test {
 protected:
  explicit GrblDoor(GrblBoard::Options options = {}) : shop(std::move(options)) {}
  void SetUp() override {
    shop.begin();
    shop.program.spindle(3000);
    for (int i = 1; i <= 40; ++i) shop.program.line(i * 2, 0, 1200);
    shop.program.end();
    ASSERT_TRUE(shop.pass_until([&] { return shop.x() > 5; }));
    open_and_close();
  }
  void open_and_close() {
    shop.board.open_door();
    shop.pass(1);
    shop.board.close_door();
    shop.pass(1);
  }
  double moved_in(double seconds) {
    const double before = shop.board.traveled();
    shop.pass(seconds);
    return shop.board.traveled() - before;
  }
  GrblShop shop;
};

class GrblHalDoor : public GrblDoor {
 protected:
  GrblHalDoor() : GrblDoor({.is_grbl_hal = true}) {}
};

TEST_F(GrblDoor, IsLeftWithOneCycleStart) {
  EXPECT_TRUE(shop.machine.resume());
  EXPECT_EQ(moved_in(3), 0) << "the spindle comes up";
  EXPECT_GT(moved_in(3), 10);
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.machine.state(), MachineState::Completed);
}

TEST_F(GrblDoor, ThatOpensAgainMeanwhileNeedsTheOperatorAgain) {
  EXPECT_TRUE(shop.machine.resume());
  shop.pass(1);
  open_and_close();
  EXPECT_EQ(moved_in(8), 0);
  EXPECT_TRUE(shop.machine.resume());
  EXPECT_GT(moved_in(8), 10);
}

TEST_F(GrblDoor, AHoldWhileTheSpindleComesUpKeepsTheAxesAtRest) {
  EXPECT_TRUE(shop.machine.resume());
  shop.pass(1);
  shop.machine.hold();
  EXPECT_EQ(moved_in(10), 0);
  EXPECT_EQ(shop.machine.state(), MachineState::Held);
  EXPECT_TRUE(shop.machine.resume());
  EXPECT_EQ(moved_in(3), 0) << "the spindle comes up again";
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.machine.state(), MachineState::Completed) << shop.alarm();
}

// Each moment between the command and the report that shows what the board makes of it.
TEST_F(GrblDoor, AHoldRightAfterAResumeKeepsTheAxesAtRest) {
  for (int milliseconds = 0; milliseconds < 120; milliseconds += 7) {
    EXPECT_TRUE(shop.machine.resume());
    shop.pass(milliseconds / 1000.0);
    shop.machine.hold();
    EXPECT_EQ(moved_in(6), 0) << milliseconds;
  }
}

TEST_F(GrblDoor, AHoldThatWasLostIsRepeatedBeforeTheAxesMove) {
  EXPECT_TRUE(shop.machine.resume());
  shop.pass(1);
  shop.is_cut = true;
  shop.machine.hold();
  shop.pass(0.05);
  shop.is_cut = false;
  EXPECT_EQ(moved_in(10), 0);
}

TEST_F(GrblDoor, AnOverrideOfZeroKeepsTheAxesAtRest) {
  EXPECT_TRUE(shop.machine.resume());
  shop.pass(1);
  shop.machine.set_panel({.feed_override = 0});
  EXPECT_EQ(moved_in(10), 0);
  shop.machine.set_panel({});
  EXPECT_EQ(moved_in(10), 0) << "a door is left by the operator";
  EXPECT_TRUE(shop.machine.resume());
  EXPECT_GT(moved_in(8), 10);
}

TEST_F(GrblDoor, AnAbortWhileTheSpindleComesUpMovesNothingAndKeepsThePosition) {
  EXPECT_TRUE(shop.machine.resume());
  shop.pass(1);
  shop.machine.abort();
  EXPECT_EQ(moved_in(15), 0);
  EXPECT_EQ(shop.machine.state(), MachineState::Aborted);
  EXPECT_TRUE(shop.machine.check_begin(shop.machine.status().position)) << "no alarm of the board";
  EXPECT_FALSE(shop.board.is_spindle_on());
}

TEST_F(GrblDoor, TheBoardsOwnCycleStartMovesNothing) {
  shop.board.receive("~");
  EXPECT_EQ(moved_in(10), 0);
  EXPECT_EQ(shop.machine.state(), MachineState::Held);
}

TEST_F(GrblHalDoor, AnAbortWhileTheSpindleComesUpMovesNothingAndKeepsThePosition) {
  EXPECT_TRUE(shop.machine.resume());
  shop.pass(1);
  shop.machine.abort();
  EXPECT_EQ(moved_in(15), 0);
  EXPECT_EQ(shop.machine.state(), MachineState::Aborted);
  EXPECT_TRUE(shop.machine.check_begin(shop.machine.status().position)) << "no alarm of the board";
}

// It takes neither a hold nor the door's byte meanwhile.
TEST_F(GrblHalDoor, AHoldTakesEffectAsSoonAsTheAxesBegin) {
  EXPECT_TRUE(shop.machine.resume());
  shop.pass(1);
  shop.machine.hold();
  EXPECT_LT(moved_in(10), 2);
  EXPECT_EQ(shop.machine.state(), MachineState::Held);
}

}  // namespace
}  // namespace dripline::machine::grbl::test
