#include <gmock/gmock.h>

#include "tests/unit/protocol/wire/control_line.hpp"

/// The reader and punch of Fanuc controls, started and stopped by DC1 to DC4.
namespace dripline::wire {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test_support::TestedLine;
using testing::HasSubstr;
using namespace std::string_literals;

TEST(DcCodes, ControlStartsAndStopsTheReader) {
  TestedLine control(template_with("fanuc"), Role::Control);
  ASSERT_TRUE(control.line->begin_receive("", control.now));
  EXPECT_EQ(control.say(), "\x11");
  control.hear("%\nO1\nM30\n%");
  EXPECT_EQ(control.say(), "\x13");
  EXPECT_EQ(control.events(), "receiving\ntext \"O1\\nM30\\n\"\nreceived\n");
}

TEST(DcCodes, HostSendsWhenTheReaderIsStarted) {
  TestedLine host(template_with("fanuc"), Role::Host);
  host.hear("\x11");
  EXPECT_EQ(host.events(), "resumed\nwants a program\n");
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("O1\nM30\n"));
  EXPECT_EQ(host.say(), "%\nO1\nM30\n%");
  EXPECT_EQ(host.events(), "sending\nsent\n");
}

/// The control is in the middle of a program, and lets us go on with it.
TEST(DcCodes, HostTakesNoReleaseOfABrokenProgramForTheStartOfAnother) {
  for (const bool is_begun_before : {false, true}) {
    TestedLine host(template_with("fanuc"), Role::Host);
    host.hear("\x11");
    ASSERT_TRUE(host.line->begin_send("", host.now));
    ASSERT_TRUE(host.offer("O1\nG1 X1\nM30\n"));
    EXPECT_EQ(host.say(4), "%\nO1");
    host.hear("\x13");
    host.line->abort(host.now);
    host.events();
    if (is_begun_before) {
      ASSERT_TRUE(host.line->begin_send("", host.now));
    }
    host.hear("\x11");
    EXPECT_THAT(host.events(), HasSubstr("DC1 came for the program that was broken off"));
    EXPECT_FALSE(host.line->state().is_asked);
    if (!is_begun_before) {
      ASSERT_TRUE(host.line->begin_send("", host.now));
    }
    ASSERT_TRUE(host.offer("O2\nM30\n"));
    EXPECT_EQ(host.say(), "");
    EXPECT_TRUE(host.line->state().awaits_start);
    host.hear("\x11");
    EXPECT_EQ(host.say(), "%\nO2\nM30\n%");
  }
}

TEST(DcCodes, HostThatWasReplacedInTheMiddleTakesNoReleaseForAStart) {
  TestedLine host(template_with("fanuc"), Role::Host);
  host.line->expect_release();
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("O2\nM30\n"));
  host.hear("\x11");
  EXPECT_EQ(host.say(), "");
  host.hear("\x11");
  EXPECT_EQ(host.say(), "%\nO2\nM30\n%");
}

TEST(DcCodes, HostIsStartedByAControlThatWasResetAfterABrokenProgram) {
  TestedLine host(template_with("fanuc"), Role::Host);
  host.hear("\x11");
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("O1\nM30\n"));
  host.say(4);
  host.hear("\x13");
  host.line->abort(host.now);
  host.hear("\x13\x11");  // reset, start
  EXPECT_TRUE(host.line->state().is_asked);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("O2\n"));
  EXPECT_EQ(host.say(), "%\nO2\n%");
}

TEST(DcCodes, HostStopsAControlThatBeginsToPrintWhileNothingCanBeKept) {
  TestedLine host(template_with("fanuc"), Role::Host);
  host.line->set_ready(false, host.now);
  EXPECT_EQ(host.say(), "") << "nothing is printed";
  host.hear("\x12");
  EXPECT_EQ(host.say(), "\x13");
  host.hear("A\n\x14");
  host.line->set_ready(true, host.now);
  EXPECT_EQ(host.say(), "\x11") << "what was held is let go, though its text has ended";
}

TEST(DcCodes, HostNeedsAnotherDc1ForTheNextProgram) {
  TestedLine host(template_with("fanuc"), Role::Host);
  host.hear("\x11");
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("O1\n"));
  host.say();
  host.hear("\x13");
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("O2\n"));
  EXPECT_EQ(host.say_now(), "");
  host.hear("\x11");
  EXPECT_EQ(host.say(), "%\nO2\n%");
}

TEST(DcCodes, KeepsTheReadersStartForTheProgramThatComesLater) {
  TestedLine host(template_with("fanuc"), Role::Host);
  host.hear("\x11");
  EXPECT_TRUE(host.line->state().is_asked);
  host.pass(std::chrono::hours(1));
  host.hear("\x11");
  EXPECT_EQ(host.events(), "resumed\nwants a program\n") << "one request";
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("O1\n"));
  EXPECT_EQ(host.say(), "%\nO1\n%");
  EXPECT_FALSE(host.line->state().is_asked);
}

TEST(DcCodes, TakesARequestBackWhenTheControlStopsTheReader) {
  TestedLine host(template_with("fanuc"), Role::Host);
  host.hear("\x11\x13");
  EXPECT_FALSE(host.line->state().is_asked);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("O1\n"));
  EXPECT_EQ(host.say_now(), "");
  EXPECT_TRUE(host.line->state().awaits_start);
  host.hear("\x11");
  EXPECT_EQ(host.say(), "%\nO1\n%");
}

TEST(DcCodes, TakesARequestBackWhenTheControlIsSwitchedOff) {
  TestedLine host(template_with("fanuc"), Role::Host);
  host.hear("\x11");
  host.line->lines({.dsr = false}, host.now);
  EXPECT_FALSE(host.line->state().is_asked);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("O1\n"));
  EXPECT_EQ(host.say_now(), "");
}

TEST(DcCodes, WaitsForTheOperatorWithoutALimitByDefault) {
  TestedLine host(template_with("fanuc"), Role::Host);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  host.pass(std::chrono::hours(1));
  EXPECT_EQ(host.line->state().phase, Phase::Sending);
  EXPECT_TRUE(host.line->state().may_wait_without_limit);
  EXPECT_TRUE(host.line->state().awaits_start);
  TestedLine limited(template_with("fanuc", {{"start_limit_ms", "700"}}), Role::Host);
  ASSERT_TRUE(limited.line->begin_send("", limited.now));
  limited.pass(milliseconds(700));
  EXPECT_THAT(limited.events(), HasSubstr("failed timeout: no DC1 came to start for 700 ms"));
}

TEST(DcCodes, AStopAfterTheTextsOwnEndCharacterEndsTheTransfer) {
  TestedLine host(template_with("fanuc", {{"trailer", "5"}}), Role::Host);
  host.hear("\x11");
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("%\nO1\nM30\n%\n", false));
  EXPECT_EQ(host.say_now(10), "%\nO1\nM30\n%");
  host.hear("\x13");
  EXPECT_EQ(host.say_now(), "");
  EXPECT_EQ(host.line->state().phase, Phase::Sending) << "more text may come";
  ASSERT_TRUE(host.offer("\n"));
  EXPECT_EQ(host.say_now(), "");
  EXPECT_THAT(host.events(), testing::EndsWith("sent\n"));
  EXPECT_EQ(host.line->state().phase, Phase::Idle);
}

TEST(DcCodes, AStopBeforeTheEndCharacterHoldsTheTransfer) {
  TestedLine host(template_with("fanuc"), Role::Host);
  host.hear("\x11");
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("%\nO1\nM30\n%\n"));
  EXPECT_EQ(host.say_now(9), "%\nO1\nM30\n");
  host.hear("\x13");
  EXPECT_EQ(host.say_now(), "");
  EXPECT_EQ(host.line->state().phase, Phase::Sending);
  host.hear("\x11");
  EXPECT_EQ(host.say(), "%");
}

TEST(DcCodes, TakesWhatIsPrintedWhileTheControlHoldsTheFeed) {
  TestedLine host(template_with("fanuc"), Role::Host);
  host.hear("\x11");
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("O1\nG1 X1\n", false));
  EXPECT_EQ(host.say_now(4), "%\nO1");
  host.hear("\x13");
  host.events();
  host.hear("\x12PROBE 3.14\n\x14");
  EXPECT_EQ(host.events(), "receiving\ntext \"PROBE 3.14\\n\"\nreceived\n");
  EXPECT_EQ(host.say_now(), "") << "it still holds the feed";
  host.hear("\x11");
  ASSERT_TRUE(host.offer("M30\n"));
  EXPECT_EQ(host.say(), "\nG1 X1\nM30\n%");
  EXPECT_EQ(host.events(), "resumed\nsent\n");
}

TEST(DcCodes, KeepsTextThatComesWithoutDc2WhileItSends) {
  TestedLine host(template_with("fanuc"), Role::Host);
  host.hear("\x11");
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("O1\n", false));
  host.say_now();
  host.hear("X7\n");
  EXPECT_THAT(host.events(), HasSubstr("text \"X7\\n\""));
  EXPECT_EQ(host.line->state().phase, Phase::Sending);
}

TEST(DcCodes, TakesPrintedLinesWithoutTheMarksOfAProgram) {
  TestedLine host(template_with("fanuc"), Role::Host);
  host.hear(
      "\x12"
      "B 2\n\x14");
  EXPECT_EQ(host.events(), "receiving\ntext \"B 2\\n\"\nreceived\n");
}

TEST(DcCodes, ReportsThatAPunchedProgramLostItsStartCharacter) {
  TestedLine host(template_with("fanuc"), Role::Host);
  host.hear("\x12O7\nM30\n%\x14");
  EXPECT_EQ(host.events(),
            "receiving\ntext \"O7\\nM30\\n\"\nerror corrupt: the start character before the "
            "program is missing\nreceived\n");
}

TEST(DcCodes, GivesUpWhatIsPunchedAndDoesNotEnd) {
  for (const auto* heard : {"\x12", "\x12%\nO7\n", "\x12X1\n", "%\nO7\n"}) {
    TestedLine host(template_with("fanuc", {{"answer_limit_ms", "none"}}), Role::Host);
    host.hear(heard);
    host.pass(milliseconds(9999));
    EXPECT_EQ(host.line->state().phase, Phase::Receiving) << heard;
    EXPECT_FALSE(host.line->state().may_wait_without_limit) << heard;
    host.pass(milliseconds(1));
    EXPECT_EQ(host.line->state().phase, Phase::Idle) << heard;
  }
}

TEST(DcCodes, StrayCharactersGiveWayToAProgram) {
  for (const auto* heard : {"\x12", "XYZ", "X\nO7"}) {
    TestedLine host(template_with("fanuc"), Role::Host);
    host.hear("\x11");
    host.hear(heard);
    EXPECT_TRUE(host.line->state().is_stray) << heard;
    EXPECT_TRUE(host.line->begin_send("", host.now)) << heard;
    EXPECT_THAT(host.events(), HasSubstr("received\nsending\n")) << heard;
  }
  TestedLine host(template_with("fanuc"), Role::Host);
  host.hear("\x12%\nO7\n");
  EXPECT_FALSE(host.line->state().is_stray);
  EXPECT_EQ(host.line->begin_send("", host.now).error().code, Errc::Busy);
}

TEST(DcCodes, AStopAtTheEndCharacterEndsTheTransfer) {
  TestedLine host(template_with("fanuc", {{"trailer", "50"}}), Role::Host);
  host.hear("\x11");
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("O1\n"));
  EXPECT_EQ(host.say_now(6), "%\nO1\n%");
  host.hear("\x13");
  EXPECT_EQ(host.say(), "");
  EXPECT_THAT(host.events(), testing::EndsWith("sent\n"));
}

TEST(DcCodes, ControlPunchesBetweenDc2AndDc4) {
  TestedLine control(template_with("fanuc"), Role::Control);
  ASSERT_TRUE(control.line->begin_send("", control.now));
  ASSERT_TRUE(control.offer("O7\nM30\n"));
  EXPECT_EQ(control.say(), "\x12%\nO7\nM30\n%\x14");
}

TEST(DcCodes, ControlContinuesToListenAfterItsPunching) {
  TestedLine control = receiving("fanuc");
  ASSERT_TRUE(control.line->begin_send("", control.now));
  ASSERT_TRUE(control.offer("X1\n"));
  control.say();
  control.hear("%\nO1\n%");
  EXPECT_EQ(control.events(), "sending\nsent\ntext \"O1\\n\"\nreceived\n");
}

TEST(DcCodes, IsOneThingAtATime) {
  TestedLine control = receiving("fanuc");
  control.hear("%\nO1");
  const auto begun = control.line->begin_send("", control.now);
  ASSERT_FALSE(begun);
  EXPECT_EQ(begun.error().code, Errc::Busy);
}

TEST(DcCodes, HostTakesWhatIsPunched) {
  TestedLine host(template_with("fanuc"), Role::Host);
  host.hear("\x12%\nO7\nM30\n%\x14");
  EXPECT_EQ(host.events(), "receiving\ntext \"O7\\nM30\\n\"\nreceived\n");
}

TEST(DcCodes, HostReportsThatAPunchedProgramIsNotComplete) {
  TestedLine host(template_with("fanuc"), Role::Host);
  host.hear("\x12%\nO7\n\x14");
  EXPECT_THAT(host.events(), HasSubstr("failed corrupt: DC4 came before the end character"));
}

TEST(DcCodes, TenCharactersMayFollowDc3) {
  TestedLine control = receiving("fanuc");
  control.hear("%\nO1\n");
  control.line->set_ready(false, control.now);
  EXPECT_EQ(control.say(), "\x13");
  control.hear("0123456789");
  EXPECT_EQ(control.events(), "text \"O1\\n0123456789\"\n");
  control.hear("0");
  EXPECT_THAT(control.events(), HasSubstr("failed limit_exceeded: alarm 087: more than 10"));
}

TEST(DcCodes, CountsNothingBeforeItsDc3HasLeft) {
  TestedLine control = receiving("fanuc");
  control.line->set_ready(false, control.now);
  control.hear("%\n012345678901234567890123456789");
  EXPECT_THAT(control.events(), testing::Not(HasSubstr("failed")));
}

TEST(DcCodes, ControlNamesItsAlarms) {
  TestedLine control = receiving("fanuc");
  control.hear("%\nO1");
  control.hear_fault(LineFault::Parity);
  EXPECT_THAT(control.events(), HasSubstr("failed corrupt: alarm 085: parity error"));
  EXPECT_EQ(control.say(), "\x13");

  TestedLine other = receiving("fanuc");
  other.line->lines({.dsr = false}, other.now);
  EXPECT_THAT(other.events(), HasSubstr("failed io: alarm 086"));
}

TEST(DcCodes, SteerInIsoWithTheirParity) {
  TestedLine control(template_with("fanuc", {{"line", "4800n82"}, {"code", "iso"}}), Role::Control);
  ASSERT_TRUE(control.line->begin_receive("", control.now));
  control.say();
  control.line->set_ready(false, control.now);
  EXPECT_EQ(control.say(), "\x93");
}

}  // namespace
}  // namespace dripline::wire
