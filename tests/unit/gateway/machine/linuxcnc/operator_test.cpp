#include "tests/unit/gateway/machine/linuxcnc/fake_helper.hpp"

namespace dripline::machine::linuxcnc::test {
namespace {

TEST(LinuxCncOverrides, AreSentBeforeTheFirstLineOfAProgram) {
  FakeHelper helper;
  helper.pass(1ms);
  EXPECT_EQ(helper.commands, "") << "LinuxCNC may be at something of its own";
  helper.session.set_active(true, helper.now);
  (void)helper.session.prepare(helper.now);
  helper.session.feed_opened("/fifo", helper.now);
  helper.pass(1ms);
  EXPECT_TRUE(helper.commands.starts_with(kOverridesOf100)) << helper.commands;
}

TEST(LinuxCncOverrides, ThatWereSetWhileTheHelperWasAwayAreSent) {
  FakeHelper helper;
  helper.session.set_overrides({.feed_override = 1.5});
  helper.pass(1ms);
  EXPECT_NE(helper.commands.find("\"feed\":1.5000"), std::string::npos);
  helper.session.lost("the helper has ended");
  helper.session.set_overrides({});
  helper.session.opened(helper.now);
  helper.say(std::string(kHello));
  helper.report();
  helper.commands.clear();
  helper.session.set_active(true, helper.now);
  (void)helper.session.prepare(helper.now);
  helper.session.feed_opened("/fifo", helper.now);
  helper.pass(1ms);
  EXPECT_TRUE(helper.commands.starts_with(kOverridesOf100)) << helper.commands;
}

TEST(LinuxCncOverrides, AreSentOnceAndWhenTheyChange) {
  FakeHelper helper;
  helper.open();
  helper.session.set_overrides({});
  helper.pass(1ms);
  EXPECT_EQ(helper.commands, "");
  helper.session.set_overrides({.feed_override = 0.5});
  helper.pass(1ms);
  EXPECT_NE(helper.commands.find("\"feed\":0.5000"), std::string::npos);
  helper.commands.clear();
  helper.session.set_overrides({});
  helper.pass(1ms);
  EXPECT_NE(helper.commands.find("\"feed\":1.0000"), std::string::npos);
}

class LinuxCncHoming : public testing::Test {
 protected:
  void SetUp() override {
    EXPECT_FALSE(helper.session.is_homing());
    helper.homed = false;
    helper.report();
    ASSERT_TRUE(helper.session.home(helper.now));
    EXPECT_TRUE(helper.session.is_homing()) << "the command is not carried out yet";
    helper.pass(1ms);
  }
  FakeHelper helper;
};

TEST_F(LinuxCncHoming, IsEndedByAnAbortThatFollowsIt) {
  helper.session.stop_homing(helper.now);
  helper.pass(1ms);
  const auto abort = helper.commands.find("\"do\":\"abort\"");
  ASSERT_NE(abort, std::string::npos);
  EXPECT_LT(helper.commands.find("\"do\":\"home\""), abort);
}

TEST_F(LinuxCncHoming, LastsUntilNoAxisHomesForAWhile) {
  helper.obey();
  helper.pass(100ms);
  helper.report();
  EXPECT_TRUE(helper.session.is_homing()) << "the axes have not begun";
  helper.homing = true;
  helper.pass(5s);
  helper.report();
  EXPECT_TRUE(helper.session.is_homing());
  helper.homing = false;
  helper.pass(100ms);
  helper.report();
  EXPECT_TRUE(helper.session.is_homing()) << "the next axis follows";
  helper.homed = true;
  helper.pass(600ms);
  helper.report();
  EXPECT_FALSE(helper.session.is_homing());
}

TEST_F(LinuxCncHoming, IsNothingThatAHoldOfAProgramStops) {
  helper.obey();
  helper.homed = true;
  helper.report();
  helper.session.set_active(true, helper.now);
  EXPECT_FALSE(helper.session.is_homing());
}

}  // namespace
}  // namespace dripline::machine::linuxcnc::test
