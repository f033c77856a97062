// Homing and unlocking a board, and how far its position can be that of the run.
#include <gmock/gmock.h>

#include "tests/unit/gateway/machine/grbl/grbl_shop.hpp"

namespace dripline::machine::grbl::test {
namespace {

TEST(GrblReference, HomesALockedBoardInItsOwnTime) {
  GrblShop shop({.is_locked = true, .start = {12, 0, 0, 0}});
  EXPECT_TRUE(shop.machine.home());
  shop.pass(6);
  EXPECT_EQ(shop.machine.reopen_reason(), "") << "it reports nothing while it homes";
  EXPECT_FALSE(shop.machine.home()) << "it is at it";
  shop.pass(3);
  EXPECT_TRUE(shop.machine.check_begin({}));
}

TEST(GrblReference, DoesNotHomeABoardWithoutReferencePoints) {
  GrblShop shop;
  EXPECT_EQ(shop.machine.home().error().code, Errc::Unsupported);
}

TEST(GrblReference, NamesTheAlarmThatKeepsTheBoardFromStarting) {
  GrblShop shop;
  EXPECT_EQ(shop.machine.notice(), "");
  shop.board.raise_alarm(9);
  shop.pass(1);
  EXPECT_EQ(shop.machine.notice(),
            "the board is in alarm 9 (homing failed: no limit switch was found): home the axes "
            "($H), or unlock it ($X)");
}

TEST(GrblReference, UnlocksABoardOnlyOnCommand) {
  GrblShop shop({.is_locked = true});
  shop.pass(30);
  EXPECT_FALSE(shop.machine.check_begin({}));
  EXPECT_TRUE(shop.machine.unlock());
  shop.pass(1);
  EXPECT_TRUE(shop.machine.check_begin({}));
}

TEST(GrblReference, TheEmergencyStopEndsHoming) {
  GrblShop shop({.is_locked = true});
  EXPECT_TRUE(shop.machine.home());
  shop.pass(1);
  shop.machine.set_panel({.emergency_stop = true});
  shop.pass(2);
  EXPECT_NE(shop.board.real_time.find('\x18'), std::string::npos);
  EXPECT_FALSE(shop.machine.home()) << "while it is pressed";
  shop.machine.set_panel({});
  shop.pass(1);
  EXPECT_FALSE(shop.machine.check_begin({})) << "not homed";
  EXPECT_TRUE(shop.machine.home());
}

TEST(GrblReference, AStopEndsHoming) {
  for (const char* by : {"stop_homing", "hold", "abort", "the end of the gateway"}) {
    GrblShop shop({.is_locked = true});
    EXPECT_FALSE(shop.machine.stop_homing());
    EXPECT_TRUE(shop.machine.home());
    shop.pass(1);
    EXPECT_FALSE(shop.machine.check_begin({})) << "it is at it";
    const std::string_view how = by;
    if (how == "hold")
      shop.machine.hold();
    else if (how == "abort")
      shop.machine.abort();
    else if (how == "stop_homing")
      EXPECT_TRUE(shop.machine.stop_homing());
    else
      shop.machine.line_closing();
    shop.pass(0.05);
    EXPECT_NE(shop.board.real_time.find('\x18'), std::string::npos) << by;
    shop.pass(9);
    EXPECT_FALSE(shop.machine.stop_homing());
    EXPECT_FALSE(shop.machine.check_begin({})) << "not homed";
    EXPECT_EQ(shop.machine.position_trust(), PositionTrust::Lost);
    EXPECT_TRUE(shop.machine.home()) << by;
  }
}

TEST(GrblReference, NoProgramBeginsWhileItHomes) {
  GrblShop shop({.is_locked = true});
  EXPECT_TRUE(shop.machine.home());
  shop.pass(9);
  ASSERT_TRUE(shop.machine.check_begin({}));
  EXPECT_TRUE(shop.machine.home()) << "once more";
  EXPECT_FALSE(shop.machine.check_begin({}));
  shop.pass(9);
  EXPECT_TRUE(shop.machine.check_begin({}));
}

/// What a restart may rely on.
class GrblTrust : public ::testing::Test {
 protected:
  void run_and_abort(GrblShop& shop) {
    shop.begin(shop.x());
    shop.program.line(shop.x() + 50, 0, 1200);
    ASSERT_TRUE(shop.pass_until([&] { return shop.board.is_moving(); }));
    shop.pass(1);
    shop.machine.abort();
    ASSERT_TRUE(shop.pass_until_over(5));
    shop.pass(1);
  }
};

TEST_F(GrblTrust, IsKeptAfterARunThatBeganHomed) {
  GrblShop shop({.is_locked = true, .start = {12, 0, 0, 0}});
  EXPECT_EQ(shop.machine.position_trust(), PositionTrust::Lost) << "the board woke up locked";
  ASSERT_TRUE(shop.machine.home());
  shop.pass(9);
  EXPECT_EQ(shop.machine.position_trust(), PositionTrust::Homed);
  EXPECT_FALSE(shop.machine.rests_at()) << "the axes are not where a run before stopped";
  run_and_abort(shop);
  EXPECT_EQ(shop.machine.position_trust(), PositionTrust::Homed);
  EXPECT_TRUE(shop.machine.rests_at());
}

TEST_F(GrblTrust, IsLostWithThePowerOfTheBoardAndNotKeptByUnlocking) {
  GrblShop shop({.is_locked = true});
  ASSERT_TRUE(shop.machine.home());
  shop.pass(9);
  run_and_abort(shop);
  shop.board.restart();
  shop.pass(1);
  EXPECT_EQ(shop.machine.position_trust(), PositionTrust::Lost);
  EXPECT_FALSE(shop.machine.rests_at());
  shop.board.raise_alarm(11);
  shop.pass(1);
  ASSERT_TRUE(shop.machine.unlock());
  shop.pass(1);
  EXPECT_EQ(shop.machine.position_trust(), PositionTrust::Unlocked);
  EXPECT_FALSE(shop.machine.rests_at());
  run_and_abort(shop);
  EXPECT_EQ(shop.machine.position_trust(), PositionTrust::Unlocked) << "a program is no proof";
  EXPECT_TRUE(shop.machine.rests_at()) << "of that program";
}

TEST_F(GrblTrust, OfALineThatWasOpenedAgainIsLess) {
  GrblShop shop({.is_locked = true});
  ASSERT_TRUE(shop.machine.home());
  shop.pass(9);
  shop.machine.line_lost("pulled out");
  EXPECT_EQ(shop.machine.position_trust(), PositionTrust::Reconnected);
  shop.machine.line_opened();
  shop.pass(2);
  EXPECT_EQ(shop.machine.position_trust(), PositionTrust::Reconnected);
  EXPECT_TRUE(shop.machine.rests_at());
}

/// The line was open all the time: what was lost stays lost, what was kept stays kept.
TEST_F(GrblTrust, IsNoOtherAfterAFaultAndTheEmergencyStop) {
  constexpr int kNoContact = 5, kLimitSwitch = 1;
  for (const int alarm : {kNoContact, kLimitSwitch}) {
    GrblShop shop({.is_locked = true});
    ASSERT_TRUE(shop.machine.home());
    shop.pass(9);
    shop.begin(shop.x());
    shop.program.dwell(100);
    shop.pass(1);
    shop.board.raise_alarm(alarm);
    ASSERT_TRUE(shop.pass_until_over(5));
    ASSERT_NE(shop.alarm(), "");
    shop.machine.set_panel({.emergency_stop = true});
    shop.pass(1);
    shop.machine.set_panel({});
    shop.pass(2);
    EXPECT_EQ(shop.machine.position_trust(),
              alarm == kNoContact ? PositionTrust::Homed : PositionTrust::Lost);
  }
}

TEST_F(GrblTrust, IsKeptByAnAlarmThatStopsTheAxesUnderControl) {
  constexpr int kNoContact = 5, kLimitSwitch = 1;
  GrblShop shop({.is_locked = true});
  ASSERT_TRUE(shop.machine.home());
  shop.pass(9);
  run_and_abort(shop);
  shop.board.raise_alarm(kNoContact);
  shop.pass(1);
  EXPECT_EQ(shop.machine.position_trust(), PositionTrust::Homed);
  shop.board.raise_alarm(kLimitSwitch);
  shop.pass(1);
  EXPECT_EQ(shop.machine.position_trust(), PositionTrust::Lost);
}

TEST_F(GrblTrust, AMachineThatIsHomedBeforeProgramsIsNotOnlyUnlocked) {
  interpreter::MachineData stated;
  stated.homing = true;
  GrblShop shop({.is_locked = true}, {}, stated);
  ASSERT_TRUE(shop.machine.unlock());
  shop.pass(1);
  const auto refused = shop.machine.check_begin({});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().what, ::testing::HasSubstr("home it"));
  ASSERT_TRUE(shop.machine.home());
  shop.pass(9);
  EXPECT_TRUE(shop.machine.check_begin({}));
}

}  // namespace
}  // namespace dripline::machine::grbl::test
