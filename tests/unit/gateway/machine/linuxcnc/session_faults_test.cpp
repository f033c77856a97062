// Where LinuxCNC is not ready, refuses, or stops by itself.
#include "gateway/machine/linuxcnc/session.hpp"

#include "tests/unit/gateway/machine/linuxcnc/fake_helper.hpp"

namespace dripline::machine::linuxcnc::test {
namespace {

TEST(LinuxCncSession, AStopOfItsOwnIsAnAlarmWithItsText) {
  FakeHelper helper;
  helper.open();
  helper.session.send("G1X1", true, {});
  helper.interpreter = 1;
  helper.report();
  EXPECT_EQ(helper.fault(), "") << "its message follows";
  helper.say(R"({"message":11,"text":"Requested tool 99 not found in the tool table"})");
  helper.report();
  EXPECT_EQ(helper.fault(), "LCN0001");
  EXPECT_EQ(helper.session.fault()->text,
            "LinuxCNC has stopped the program: error 11 of LinuxCNC, Requested tool 99 not found "
            "in the tool table");
}

struct FaultCase {
  const char* name;
  const char* id;
  void (*happens)(FakeHelper&);
};

class LinuxCncFault : public testing::TestWithParam<FaultCase> {};

TEST_P(LinuxCncFault, IsAnAlarmAndNothingIsSentUntilTheReset) {
  FakeHelper helper;
  helper.open();
  helper.session.send("G1X1", true, {});
  helper.pass(1ms);
  GetParam().happens(helper);
  EXPECT_EQ(helper.fault(), GetParam().id);
  EXPECT_FALSE(helper.session.may_send(10));
  EXPECT_FALSE(helper.session.resume(helper.now));
  EXPECT_FALSE(helper.session.check_ready());
}

INSTANTIATE_TEST_SUITE_P(, LinuxCncFault,
                         testing::Values(FaultCase{"lost_helper", "LCN0005",
                                                   [](FakeHelper& it) { it.session.lost("gone"); }},
                                         FaultCase{"machine_off", "LCN0002",
                                                   [](FakeHelper& it) {
                                                     it.state = 3;
                                                     it.report();
                                                     it.now += 200ms;
                                                     it.report();
                                                   }},
                                         FaultCase{"emergency_stop_at_the_machine", "LCN0002",
                                                   [](FakeHelper& it) {
                                                     it.state = 1;
                                                     it.report();
                                                     it.now += 200ms;
                                                     it.report();
                                                   }},
                                         FaultCase{"line_never_sent", "LCN0007",
                                                   [](FakeHelper& it) {
                                                     it.motion = 1000;
                                                     it.report();
                                                   }},
                                         FaultCase{"read_line_never_sent", "LCN0007",
                                                   [](FakeHelper& it) {
                                                     it.read = 1000;
                                                     it.report();
                                                   }},
                                         FaultCase{"answer_to_nothing", "LCN0007",
                                                   [](FakeHelper& it) { it.done(77); }},
                                         FaultCase{"garbage", "LCN0007",
                                                   [](FakeHelper& it) {
                                                     for (int i = 0; i < 4; ++i)
                                                       it.say("Traceback");
                                                   }},
                                         FaultCase{"refused_command", "LCN0006",
                                                   [](FakeHelper& it) { it.done(1, "no"); }},
                                         FaultCase{"stall", "LCN0003",
                                                   [](FakeHelper& it) {
                                                     for (int i = 0; i < 400; ++i) {
                                                       it.report();
                                                       it.pass(100ms);
                                                     }
                                                   }}),
                         [](const auto& i) { return std::string{i.param.name}; });

TEST(LinuxCncSession, ASilentOrFloodingHelperIsStartedAgain) {
  FakeHelper helper;
  helper.pass(7s);
  EXPECT_NE(helper.session.reopen_reason(), "");
  FakeHelper other;
  for (int i = 0; i < 300; ++i) other.say(std::string(4000, 'x'));
  EXPECT_EQ(other.session.reopen_reason(), "the helper floods");
}

TEST(LinuxCncSession, TheNextHelperBeginsWithAStopOfWhatIsLeft) {
  FakeHelper helper;
  helper.open();
  helper.session.send("G1X1", true, {});
  helper.session.lost("gone");
  EXPECT_TRUE(helper.session.wants_feed()) << "LinuxCNC must not wait for a line";
  helper.session.opened(helper.now);
  helper.pass(1ms);
  EXPECT_NE(helper.commands.find("pause"), std::string::npos);
}

struct RefusalCase {
  const char* name;
  const char* text;
  void (*set)(FakeHelper&);
};

class LinuxCncRefusal : public testing::TestWithParam<RefusalCase> {};

TEST_P(LinuxCncRefusal, NamesWhatIsMissing) {
  FakeHelper helper;
  GetParam().set(helper);
  helper.report();
  const auto ready = helper.session.check_ready();
  ASSERT_FALSE(ready);
  EXPECT_NE(ready.error().what.find(GetParam().text), std::string::npos) << ready.error().what;
}

INSTANTIATE_TEST_SUITE_P(
    , LinuxCncRefusal,
    testing::Values(RefusalCase{"emergency_stop", "emergency stop",
                                [](FakeHelper& it) { it.state = 1; }},
                    RefusalCase{"off", "the machine off", [](FakeHelper& it) { it.state = 3; }},
                    RefusalCase{"not_homed", "not homed", [](FakeHelper& it) { it.homed = false; }},
                    RefusalCase{"other_program", "executing a program",
                                [](FakeHelper& it) { it.interpreter = 2; }},
                    RefusalCase{"moving", "moving", [](FakeHelper& it) { it.velocity = 1; }},
                    RefusalCase{"ended", "LinuxCNC has ended",
                                [](FakeHelper& it) { it.session.lost("LinuxCNC has ended"); }},
                    RefusalCase{"long_read_ahead", "INTERP_MAX_LEN",
                                [](FakeHelper& it) {
                                  it.session.opened(it.now);
                                  std::string hello(kHello);
                                  hello.replace(hello.find("ahead\":2"), 8, "ahead\":1000");
                                  it.say(hello);
                                }}),
    [](const auto& i) { return std::string{i.param.name}; });

TEST(LinuxCncSession, AWorkSystemThatIsNotZeroIsAnAlarmBeforeTheFirstMove) {
  FakeHelper helper;
  helper.session.set_active(true, helper.now);
  (void)helper.session.prepare(helper.now);
  helper.session.feed_opened("/fifo", helper.now);
  helper.pass(1ms);
  helper.obey();
  helper.interpreter = 2;
  helper.read = 5;
  helper.has_offset = true;
  helper.report();
  EXPECT_FALSE(helper.session.prepare(helper.now));
  EXPECT_EQ(helper.fault(), "LCN0004");
}

TEST(LinuxCncSession, AnAxisThatBeginsAnewAt360DegreesIsRefused) {
  FakeHelper helper;
  helper.session.lost("again");
  helper.session.opened(helper.now);
  std::string hello(kHello);
  hello.replace(hello.find("\"axes\":7"), 8, "\"axes\":15");
  hello.replace(hello.find("\"wrapped\":0"), 11, "\"wrapped\":8");
  helper.say(hello);
  helper.report();
  const auto ready = helper.session.check_ready();
  ASSERT_FALSE(ready);
  EXPECT_NE(ready.error().what.find("[AXIS_A]WRAPPED_ROTARY"), std::string::npos)
      << ready.error().what;
}

}  // namespace
}  // namespace dripline::machine::linuxcnc::test
