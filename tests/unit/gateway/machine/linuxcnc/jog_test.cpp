#include "tests/unit/gateway/machine/linuxcnc/fake_helper.hpp"

namespace dripline::machine::linuxcnc::test {
namespace {

using interpreter::Axis;

class LinuxCncJog : public testing::Test {
 protected:
  void begin(double distance = -2) {
    ASSERT_TRUE(helper.session.check_ready());
    ASSERT_TRUE(helper.session.jog({.axis = Axis::X, .distance = distance, .feed_per_minute = 600},
                                   helper.now));
    helper.pass(1ms);
  }
  void report_for(std::chrono::milliseconds time) {
    for (auto passed = 0ms; passed < time; passed += 10ms) {
      helper.pass(10ms);
      helper.report();
    }
  }
  FakeHelper helper;
};

TEST_F(LinuxCncJog, IsItsOwnAndEndsWhenTheAxesStandStillAtTheEnd) {
  begin();
  EXPECT_EQ(helper.commands,
            "{\"n\":1,\"do\":\"jog\",\"axis\":0,\"velocity\":-10.000000000,"
            "\"distance\":2.000000000}\n");
  report_for(1s);
  EXPECT_TRUE(helper.session.is_jogging()) << "not handed over yet";
  EXPECT_FALSE(helper.session.check_ready());
  helper.obey();
  for (int i = 1; i <= 20; ++i) {
    helper.x = -0.1 * i;
    report_for(10ms);
    EXPECT_TRUE(helper.session.is_jogging());
  }
  report_for(150ms);
  EXPECT_FALSE(helper.session.is_jogging());
  EXPECT_EQ(helper.session.jog_fault(), "");
  EXPECT_TRUE(helper.session.check_ready());
}

TEST_F(LinuxCncJog, ThatDoesNotBeginAtOnceIsWaitedFor) {
  begin();
  helper.obey();
  report_for(300ms);
  EXPECT_TRUE(helper.session.is_jogging());
  report_for(400ms);
  EXPECT_FALSE(helper.session.is_jogging()) << "LinuxCNC does not move it";
}

TEST_F(LinuxCncJog, IsStoppedByItsOwnCommand) {
  begin();
  helper.obey();
  helper.x = -0.5;
  report_for(20ms);
  helper.session.stop_jog(helper.now);
  helper.session.stop_jog(helper.now);
  helper.pass(1ms);
  EXPECT_EQ(helper.commands, "{\"n\":2,\"do\":\"stop_jog\",\"axis\":0}\n");
  helper.obey();
  helper.x = -0.6;
  report_for(150ms);
  EXPECT_FALSE(helper.session.is_jogging());
}

TEST_F(LinuxCncJog, ARefusalAnAlarmAndALostHelperAreItsFault) {
  begin();
  helper.done(1, "not now");
  EXPECT_FALSE(helper.session.is_jogging());
  EXPECT_EQ(helper.session.jog_fault(), "LinuxCNC refuses it: not now");
  begin();
  helper.obey();
  helper.state = 1;
  helper.report();
  EXPECT_NE(helper.session.jog_fault().find("turned the machine off"), std::string::npos);
  helper.state = 4;
  helper.report();
  begin();
  helper.session.lost("the helper has ended");
  EXPECT_FALSE(helper.session.is_jogging());
  EXPECT_EQ(helper.session.jog_fault(), "the helper has ended");
}

}  // namespace
}  // namespace dripline::machine::linuxcnc::test
