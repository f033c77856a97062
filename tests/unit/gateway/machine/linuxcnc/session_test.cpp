#include "gateway/machine/linuxcnc/session.hpp"

#include "tests/unit/gateway/machine/linuxcnc/fake_helper.hpp"

namespace dripline::machine::linuxcnc::test {
namespace {

TEST(LinuxCncSession, OpensAProgramWithTheModesThatAllLinesRelyOn) {
  FakeHelper helper;
  ASSERT_TRUE(helper.session.check_ready());
  helper.session.set_active(true, helper.now);
  EXPECT_FALSE(helper.session.prepare(helper.now));
  helper.session.feed_opened("/fifo", helper.now);
  helper.pass(1ms);
  EXPECT_EQ(helper.text,
            "%\nG21G90G94G17G40G49G80G91.1G59.3G92.2G8G97M5M9M53P1\nG61M48\nM66P0L0\n");
  EXPECT_EQ(helper.commands, "{\"n\":1,\"do\":\"run\",\"file\":\"/fifo\"}\n");
  EXPECT_FALSE(helper.session.may_send(10)) << "LinuxCNC does not read it yet";
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

TEST(LinuxCncSession, ReportsTheProbeAsItIsNow) {
  FakeHelper helper;
  EXPECT_EQ(helper.session.is_touching(), false);
  helper.touching = true;
  helper.report();
  EXPECT_EQ(helper.session.is_touching(), true);
  EXPECT_FALSE(helper.session.probe()->tripped) << "that is of the last probe move";
}

TEST(LinuxCncSession, ALineIsExecutedWhenTheNextIsInMotion) {
  FakeHelper helper;
  helper.open();
  const auto first = helper.session.send("G1X1F600", true, {});
  const auto second = helper.session.send("G1X2", true, {});
  EXPECT_EQ(first, 5U) << "lines count from 1, the % included";
  helper.read = second;  // read ahead is nothing
  helper.motion = first;
  helper.report();
  EXPECT_LT(helper.session.executed(), first);
  helper.motion = second;
  helper.report();
  EXPECT_EQ(helper.session.executed(), first);
  EXPECT_FALSE(helper.session.is_empty());
  helper.motion = 0;  // at rest: it may as well not have begun
  helper.report();
  EXPECT_EQ(helper.session.executed(), first);
}

TEST(LinuxCncSession, TheLastLineIsExecutedWhenAMarkerIsPassed) {
  FakeHelper helper;
  helper.open();
  const auto line = helper.session.send("G1X1F600", true, {});
  helper.session.await_execution();
  helper.session.await_execution();
  helper.pass(1ms);
  EXPECT_EQ(helper.text, "G1X1F600\nM66P0L0\n");
  helper.read = line + 1;
  helper.report();
  EXPECT_FALSE(helper.session.is_empty());
  helper.read = line + 2;
  helper.report();
  EXPECT_TRUE(helper.session.is_empty());
  EXPECT_GE(helper.session.executed(), line);
}

TEST(LinuxCncSession, LinesThatLinuxCncKeepsBackAreFlushedWhenNothingFollows) {
  FakeHelper helper;
  helper.open();
  helper.session.send("G61.1G0X1", true, {});
  helper.pass(1ms);
  helper.text.clear();
  helper.pass(3ms, true);
  EXPECT_EQ(helper.text, "\n\n\n") << "LinuxCNC must not wait for a line";
  helper.text.clear();
  helper.pass(5ms, true);
  EXPECT_EQ(helper.text, "G61.1\n");
  helper.text.clear();
  helper.motion = 5;
  helper.report();
  helper.pass(50ms, true);
  EXPECT_EQ(helper.text.find("M66"), std::string::npos) << "not while the axes move";
  helper.motion = 0;
  helper.report();
  helper.pass(50ms, true);
  EXPECT_NE(helper.text.find("M66P0L0"), std::string::npos);
}

TEST(LinuxCncSession, ReadAheadIsBounded) {
  FakeHelper helper;
  helper.open();
  int sent = 0;
  for (; sent < 10'000 && helper.session.may_send(10); ++sent) {
    helper.session.send("G1X1", true, {});
    helper.pass(0ms);
  }
  EXPECT_EQ(sent, 400);
}

TEST(LinuxCncSession, HoldsUntilTheOperatorContinues) {
  FakeHelper helper;
  helper.open();
  helper.session.send("G1X1", true, {});
  helper.session.hold(helper.now);
  helper.pass(1ms);
  EXPECT_NE(helper.commands.find("pause"), std::string::npos);
  EXPECT_FALSE(helper.session.may_send(10));
  helper.paused = true;
  helper.report();
  helper.commands.clear();
  EXPECT_TRUE(helper.session.resume(helper.now));
  helper.pass(1ms);
  EXPECT_NE(helper.commands.find("resume"), std::string::npos);
  EXPECT_TRUE(helper.session.is_held());
  helper.paused = false;
  helper.report();
  EXPECT_FALSE(helper.session.is_held());
}

TEST(LinuxCncSession, AHoldAtLinuxCncItselfIsAHold) {
  FakeHelper helper;
  helper.open();
  helper.paused = true;
  helper.report();
  EXPECT_TRUE(helper.session.is_held());
}

TEST(LinuxCncSession, AbortsAtStandstillAndKnowsHowFarItCame) {
  FakeHelper helper;
  helper.open();
  for (int i = 0; i < 10; ++i) helper.session.send("G1X1", true, {});
  helper.motion = 6;
  helper.report();
  helper.session.stop(false, helper.now);
  helper.pass(1ms);
  EXPECT_NE(helper.commands.find("pause"), std::string::npos);
  EXPECT_EQ(helper.commands.find("abort"), std::string::npos);
  helper.obey();
  helper.motion = 8;
  helper.paused = true;
  helper.report();
  helper.pass(1ms);
  EXPECT_NE(helper.commands.find("abort"), std::string::npos);
  EXPECT_EQ(helper.session.executed(), 7U);
  EXPECT_TRUE(helper.session.is_stopping());
  helper.obey();
  helper.motion = 0;
  helper.interpreter = 1;
  helper.paused = false;
  helper.report();
  EXPECT_FALSE(helper.session.is_stopping());
  EXPECT_FALSE(helper.session.wants_feed());
  EXPECT_EQ(helper.session.executed(), 7U);
}

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
                                  hello.replace(hello.rfind(":2}"), 3, ":1000}");
                                  it.say(hello);
                                }}),
    [](const auto& i) { return std::string{i.param.name}; });

TEST(LinuxCncSession, AWorkSystemThatIsNotZeroIsAnAlarmBeforeTheFirstMove) {
  FakeHelper helper;
  helper.session.set_active(true, helper.now);
  (void)helper.session.prepare(helper.now);
  helper.session.feed_opened("/fifo", helper.now);
  helper.pass(1ms);
  helper.done(1);
  helper.interpreter = 2;
  helper.read = 5;
  helper.has_offset = true;
  helper.report();
  EXPECT_FALSE(helper.session.prepare(helper.now));
  EXPECT_EQ(helper.fault(), "LCN0004");
}

TEST(LinuxCncSession, EndsTheProgramInTheFifo) {
  FakeHelper helper;
  helper.open();
  helper.session.set_active(false, helper.now);
  helper.pass(1ms, true);
  EXPECT_EQ(helper.text, "M2\n%\n");
  helper.interpreter = 1;
  helper.read = 0;
  helper.report();
  EXPECT_FALSE(helper.session.wants_feed());
}

TEST(LinuxCncSession, IsReadyForTheNextProgramWhenItHasFinishedOne) {
  FakeHelper helper;
  helper.open();
  EXPECT_FALSE(helper.session.finish(helper.now)) << "LinuxCNC has not read the end";
  helper.pass(1ms, true);
  EXPECT_EQ(helper.text, "M2\n%\n");
  helper.report();
  EXPECT_FALSE(helper.session.finish(helper.now));
  helper.interpreter = 1;
  helper.read = 0;
  helper.report();
  EXPECT_TRUE(helper.session.finish(helper.now));
  EXPECT_TRUE(helper.session.check_ready().has_value());
  helper.pass(1ms, true);
  EXPECT_EQ(helper.text, "M2\n%\n") << "once";
  EXPECT_EQ(helper.fault(), "");
}

TEST(LinuxCncSession, FinishesAProgramWithoutAnyLineAtOnce) {
  FakeHelper helper;
  helper.session.set_active(true, helper.now);
  EXPECT_TRUE(helper.session.finish(helper.now));
  EXPECT_FALSE(helper.session.prepare(helper.now));
  EXPECT_TRUE(helper.session.finish(helper.now));
  EXPECT_FALSE(helper.session.wants_feed());
}

TEST(LinuxCncSession, AnEndThatLinuxCncDoesNotTakeIsAnAlarm) {
  FakeHelper helper;
  helper.open();
  EXPECT_FALSE(helper.session.finish(helper.now));
  helper.pass(5s);
  helper.report();
  EXPECT_FALSE(helper.session.finish(helper.now));
  EXPECT_EQ(helper.fault(), "");
  helper.pass(2s);
  helper.report();
  EXPECT_FALSE(helper.session.finish(helper.now));
  EXPECT_EQ(helper.fault(), "LCN0006");
}

TEST(LinuxCncSession, ReadsInputs) {
  const FakeHelper helper;
  EXPECT_TRUE(helper.session.input(0));
  EXPECT_FALSE(helper.session.input(1));
  EXPECT_TRUE(helper.session.input(2));
  EXPECT_FALSE(helper.session.input(64));
  const auto inputs = helper.session.inputs();
  ASSERT_EQ(inputs.size(), 32U);
  EXPECT_EQ(inputs[2], (std::pair<std::string, bool>("2", true)));
  EXPECT_EQ(inputs[3], (std::pair<std::string, bool>("3", false)));
  EXPECT_TRUE(helper.session.input(33));
  EXPECT_FALSE(helper.session.input(32));
}

TEST(LinuxCncSession, ReadsAHalPinWhenItIsAskedFor) {
  FakeHelper helper;
  EXPECT_FALSE(helper.session.signal("tool-height", helper.now));
  EXPECT_FALSE(helper.session.signal("tool-height", helper.now)) << "it has not come yet";
  helper.pass(1ms);
  EXPECT_NE(helper.commands.find(R"("do":"hal","name":"tool-height"})"), std::string::npos);
  EXPECT_EQ(helper.commands.find("hal"), helper.commands.rfind("hal")) << "it is asked for once";
  helper.say(R"({"signal":"another","value":7})");
  EXPECT_FALSE(helper.session.signal("tool-height", helper.now));
  helper.say(R"({"signal":"tool-height","value":-12.5})");
  EXPECT_EQ(helper.session.signal("tool-height", helper.now)->value, -12.5);
  EXPECT_FALSE(helper.session.signal("tool-height", helper.now)) << "each asking gets a new value";
}

TEST(LinuxCncSession, StatesWhyAHalPinHasNoValue) {
  FakeHelper helper;
  const auto reason = [&](const std::string& name) {
    return helper.session.signal(name, helper.now)->reason;
  };
  EXPECT_EQ(reason("a\",\"do\":\"on"), "no name of a HAL pin");
  EXPECT_FALSE(helper.session.signal("nothing", helper.now));
  helper.say(R"({"signal":"nothing","problem":"Can't get value: pin / param nothing not found"})");
  EXPECT_EQ(reason("nothing"), "Can't get value: pin / param nothing not found");
  EXPECT_FALSE(helper.session.signal("slow", helper.now));
  helper.now += 7s;
  EXPECT_EQ(reason("slow"), "LinuxCNC does not answer");
  helper.session.lost("the cable is cut");
  EXPECT_EQ(reason("slow"), "LinuxCNC is not connected");
}

}  // namespace
}  // namespace dripline::machine::linuxcnc::test
