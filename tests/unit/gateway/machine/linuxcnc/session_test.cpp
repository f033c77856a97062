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
  EXPECT_EQ(helper.commands, kOverridesOf100 + "{\"n\":2,\"do\":\"run\",\"file\":\"/fifo\"}\n");
  EXPECT_FALSE(helper.session.may_send(10)) << "LinuxCNC does not read it yet";
}

TEST(LinuxCncSession, StatesByWhatLinuxCncReadsPrograms) {
  FakeHelper helper;
  helper.session.lost("again");
  helper.session.opened(helper.now);
  std::string hello(kHello);
  hello.replace(hello.find("\"startup_code\":\"\""), 17, "\"startup_code\":\"G20 G64\"");
  hello.replace(hello.find("\"settings\":\"\""), 13, "\"settings\":\"RETAIN_G43\"");
  helper.say(hello);
  const auto& reader = helper.session.rules().reader;
  ASSERT_TRUE(reader);
  EXPECT_EQ(reader->control, "rs274ngc");
  EXPECT_EQ(reader->startup_code, "G20 G64");
  EXPECT_EQ(reader->settings, "RETAIN_G43");
}

/// LinuxCNC may still have what it was sent before the helper was lost.
TEST(LinuxCncSession, AStopWhileItsHelperStartsIsSent) {
  for (const auto& [is_emergency, order] :
       {std::pair{true, "\"do\":\"emergency\""}, std::pair{false, "\"do\":\"abort\""}}) {
    FakeHelper helper;
    helper.session.lost("again");
    helper.session.opened(helper.now);
    (void)helper.session.take_commands();
    helper.session.stop(is_emergency, helper.now);
    helper.say(std::string(kHello));
    helper.pass(1ms);
    EXPECT_NE(helper.commands.find(order), std::string::npos) << helper.commands;
  }
}

TEST(LinuxCncSession, BeginsWithoutTheAdaptiveFeedOfAFormerProgram) {
  FakeHelper helper;
  helper.adaptive = true;
  helper.report();
  helper.session.set_active(true, helper.now);
  EXPECT_FALSE(helper.session.prepare(helper.now));
  helper.session.feed_opened("/fifo", helper.now);
  helper.pass(1ms);
  EXPECT_NE(helper.text.find("\nG61M48\nM52P0\nM66P0L0\n"), std::string::npos) << helper.text;
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
