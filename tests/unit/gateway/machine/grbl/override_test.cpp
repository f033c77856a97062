#include <gtest/gtest.h>

#include "tests/unit/gateway/machine/grbl/grbl_shop.hpp"

namespace dripline::machine::grbl::test {
namespace {

class GrblOverrides : public testing::Test {
 protected:
  void run(int blocks = 40) {
    shop.begin();
    for (int i = 1; i <= blocks; ++i) shop.program.line(i * 2, 0, 1200);
    shop.program.end();
    ASSERT_TRUE(shop.pass_until([&] { return shop.x() > 5; }));
  }
  void set(OperatorPanel panel) { shop.machine.set_panel(panel); }
  void inhibit_feed() {
    interpreter::OverrideInhibit inhibit;
    inhibit.feed_override = true;
    shop.program.lock(inhibit);
  }
  double moved_in(double seconds) {
    const double before = shop.board.traveled();
    shop.pass(seconds);
    return shop.board.traveled() - before;
  }
  GrblShop shop;
};

TEST_F(GrblOverrides, OverridesReachTheBoard) {
  run();
  set({.feed_override = 0.37, .rapid_override = 0.6, .spindle_override = 1.25});
  shop.pass(0.1);
  EXPECT_EQ(shop.board.feed_override(), 37);
  EXPECT_EQ(shop.board.rapid_override(), 50) << "never faster than asked";
  EXPECT_EQ(shop.board.spindle_override(), 125);
  EXPECT_NEAR(moved_in(1), 20 * 0.37, 0.5);
}

TEST_F(GrblOverrides, AnOverrideIsNeverPassedOnItsWay) {
  run();
  set({.feed_override = 0.5});
  shop.pass(1);
  ASSERT_EQ(shop.board.feed_override(), 50);
  set({.feed_override = 0.69});
  for (int i = 0; i < 1000; ++i) {
    shop.pass(0.001);
    ASSERT_LE(shop.board.feed_override(), 69);
    ASSERT_GE(shop.board.feed_override(), 50);
  }
  EXPECT_EQ(shop.board.feed_override(), 69);
}

// The board has steps of 10 and 1 %, one a report.
TEST_F(GrblOverrides, NothingBeginsAtTheEndOfAnInhibitBeforeTheOverrideIsInForceAgain) {
  set({.feed_override = 0.13});
  shop.pass(2);
  shop.begin();
  inhibit_feed();
  shop.program.line(5, 0, 1200);
  shop.program.unlock();
  shop.program.line(10, 0, 1200);
  shop.program.end();
  ASSERT_TRUE(shop.pass_until([&] { return shop.board.is_moving(); }));
  EXPECT_EQ(shop.board.feed_override(), 100) << "inhibited";
  ASSERT_TRUE(shop.pass_until([&] { return shop.board.position()[0] > 5 + 1e-6; }));
  EXPECT_EQ(shop.board.feed_override(), 13);
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.machine.state(), MachineState::Completed) << shop.alarm();
}

TEST_F(GrblOverrides, AnInhibitBeginsWithTheProgramsFeed) {
  set({.feed_override = 1.5});
  shop.pass(2);
  shop.begin();
  shop.program.line(5, 0, 1200);
  inhibit_feed();
  shop.program.line(10, 0, 1200);
  ASSERT_TRUE(shop.pass_until([&] { return shop.board.position()[0] > 5 + 1e-6; }));
  EXPECT_EQ(shop.board.feed_override(), 100);
}

TEST_F(GrblOverrides, ABoardThatTakesNoOverridesIsAnAlarm) {
  shop.board.ignores_overrides = true;
  set({.feed_override = 0.5});
  shop.begin();
  shop.program.line(5, 0, 1200);
  shop.program.end();
  ASSERT_TRUE(shop.pass_until_over(60));
  EXPECT_TRUE(shop.alarm().starts_with("GRB0006")) << shop.alarm();
  EXPECT_EQ(shop.board.traveled(), 0);
}

TEST_F(GrblOverrides, RepeatsAnOverrideThatWasLost) {
  run();
  shop.is_cut = true;
  set({.feed_override = 0.5});
  shop.pass(0.05);
  shop.is_cut = false;
  EXPECT_TRUE(shop.pass_until([&] { return shop.board.feed_override() == 50; }, 3));
}

TEST_F(GrblOverrides, AFeedOverrideOfZeroHoldsUntilItIsRaised) {
  run();
  set({.feed_override = 0.04});
  EXPECT_EQ(shop.machine.panel().feed_override, 0);
  shop.pass(0.5);
  EXPECT_EQ(moved_in(3), 0);
  EXPECT_FALSE(shop.machine.resume());
  set({.feed_override = 0.5});
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.machine.state(), MachineState::Completed) << shop.alarm();
}

TEST_F(GrblOverrides, RaisingTheOverrideEndsNoHoldOfTheOperator) {
  run();
  set({.feed_override = 0});
  shop.pass(0.5);
  shop.machine.hold();
  set({.feed_override = 1});
  EXPECT_EQ(moved_in(3), 0) << "held first by the override, then by the operator";
  EXPECT_EQ(shop.machine.state(), MachineState::Held);
  EXPECT_TRUE(shop.machine.resume());
  shop.pass(1);
  shop.machine.hold();
  shop.pass(0.5);
  set({.rapid_override = 0});
  set({.rapid_override = 1});
  EXPECT_EQ(moved_in(3), 0) << "held by the operator before";
  EXPECT_TRUE(shop.machine.resume());
  EXPECT_GT(moved_in(1), 1);
}

TEST_F(GrblOverrides, AFeedOverrideOfZeroEndsAResumeThatIsUnderWay) {
  run();
  shop.machine.hold();
  shop.pass(0.5);
  EXPECT_TRUE(shop.machine.resume());
  set({.feed_override = 0});
  EXPECT_EQ(moved_in(3), 0) << "the operator's resume";
  EXPECT_FALSE(shop.machine.resume());
  set({.feed_override = 0.15});
  EXPECT_GT(moved_in(3), 1);
  for (const double factor : {0.05, 0.15, 0.05, 0.15, 0.05}) set({.feed_override = factor});
  shop.pass(0.5);
  EXPECT_EQ(moved_in(3), 0) << "that of the override";
  set({.feed_override = 1});
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.machine.state(), MachineState::Completed) << shop.alarm();
}

TEST_F(GrblOverrides, RaisingTheOverrideStartsNothingAfterADoorWasOpen) {
  run();
  set({.feed_override = 0});
  shop.pass(0.5);
  shop.board.open_door();
  shop.pass(1);
  shop.board.close_door();
  shop.pass(0.5);
  set({.feed_override = 0.5});
  EXPECT_EQ(moved_in(3), 0);
  EXPECT_EQ(shop.machine.state(), MachineState::Held);
  EXPECT_TRUE(shop.machine.resume());
  EXPECT_GT(moved_in(1), 1);
  set({.feed_override = 0});
  shop.pass(0.5);
  set({.feed_override = 0.5});
  EXPECT_GT(moved_in(1), 1) << "a hold after that one";
}

TEST_F(GrblOverrides, AProgramBeginsNothingAtAnOverrideOfZero) {
  set({.feed_override = 0});
  shop.begin();
  shop.program.line(5, 0, 1200);
  shop.program.end();
  EXPECT_EQ(moved_in(3), 0);
  set({.feed_override = 1});
  ASSERT_TRUE(shop.pass_until_over(10));
  EXPECT_EQ(shop.machine.state(), MachineState::Completed) << shop.alarm();
}

}  // namespace
}  // namespace dripline::machine::grbl::test
