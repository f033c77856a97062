#include <gmock/gmock.h>

#include "tests/support/line/line_events.hpp"

/// What particular controls do on a plain line: Fanuc, ProtoTRAK Plus, Centurion.
namespace dripline::wire {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test_support::TestedLine;
using testing::HasSubstr;
using namespace std::string_literals;

using Setting = std::pair<std::string_view, std::string_view>;

LineSettings template_with(std::string_view name, std::initializer_list<Setting> set = {}) {
  const auto found = find_template(name);
  EXPECT_TRUE(found);
  LineSettings settings = (*found)->settings;
  for (const auto& [key, value] : set) EXPECT_TRUE(set_value(settings, key, value)) << key;
  return settings;
}

/// A control that waits for text.
TestedLine receiving(std::string_view name, std::initializer_list<Setting> set = {}) {
  TestedLine control(template_with(name, set), Role::Control);
  const auto begun = control.line->begin_receive("", control.now);
  EXPECT_TRUE(begun) << begun.error().what;
  control.say();
  control.events();
  return control;
}

// Fanuc: reader and punch by DC1 to DC4

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

// ProtoTRAK Plus. Rows: PT-01, PT-03, PT-05, PT-07.

TEST(ProtoTrakControl, KeepsOneBlockALineUpToThePercentSign) {
  TestedLine control = receiving("prototrak");
  control.hear("PN12 G20 ; G100 X1 Y2 ;\r\nG101 XB0 ;\r\n%;\r\nrest is not read");
  EXPECT_EQ(control.events(),
            "text \"PN12 G20 ;\\n G100 X1 Y2 ;\\nG101 XB0 ;\\n%\\n\"\nreceived\n");
}

TEST(ProtoTrakControl, TakesALeadingPercentSignAsAMark) {
  TestedLine control = receiving("prototrak");
  control.hear("%\r\nPN1 ;\r\n%");
  EXPECT_EQ(control.events(), "text \"PN1 ;\\n%\\n\"\nreceived\n");
}

TEST(ProtoTrakControl, FoldsSmallLettersAndSkipsLayout) {
  TestedLine control = receiving("prototrak");
  control.hear("pn1\tg21;\x7f\r\n%");
  EXPECT_EQ(control.events(), "text \"PN1G21;\\n%\\n\"\nreceived\n");
}

TEST(ProtoTrakControl, EndsAtDosEndOfFileWithAnError) {
  TestedLine control = receiving("prototrak");
  control.hear("PN1 ;\r\n\x1a");
  EXPECT_THAT(control.events(), HasSubstr("error syntax: the program ends with 0x1a"));
}

TEST(ProtoTrakControl, RefusesABlockWithoutAnEnd) {
  TestedLine control = receiving("prototrak");
  control.hear(std::string(255, 'X'));
  EXPECT_THAT(control.events(), testing::Not(HasSubstr("failed")));
  control.hear("X");
  EXPECT_THAT(control.events(), HasSubstr("failed syntax: P102: block 1 has no ';' within 255"));
}

TEST(ProtoTrakControl, RefusesForeignCharacters) {
  TestedLine control = receiving("prototrak");
  control.hear("PN1 ;\r\nG1 X=2 ;");
  EXPECT_THAT(control.events(), HasSubstr("failed syntax: P103: block 2 has the character '='"));
}

TEST(ProtoTrakControl, KeepsNothingAfterALineError) {
  for (const LineFault fault : {LineFault::Parity, LineFault::Framing}) {
    TestedLine control = receiving("prototrak");
    control.hear("PN1 ;\r\n");
    control.hear_fault(fault);
    EXPECT_THAT(control.events(), HasSubstr("failed corrupt: receive error"));
    EXPECT_EQ(control.line->state().phase, Phase::Idle);
  }
}

TEST(ProtoTrakControl, FailsAfterTenSecondsOfSilence) {
  TestedLine control = receiving("prototrak");
  control.pass(seconds(100));
  control.hear("PN1 ;");
  control.pass(milliseconds(9999));
  EXPECT_EQ(control.line->state().phase, Phase::Receiving);
  control.pass(milliseconds(1));
  EXPECT_THAT(control.events(), HasSubstr("failed timeout"));
}

TEST(ProtoTrakControl, HasNoCharactersToHoldTheHost) {
  TestedLine control = receiving("prototrak");
  control.line->set_ready(false, control.now);
  EXPECT_EQ(control.say(), "");
}

// Centurion

TEST(CenturionControl, SplitsWhatItReceivesAtOLines) {  // CEN-202
  TestedLine control = receiving("centurion", {{"split_programs", "yes"}});
  control.hear("O0001\r\nG0 X1\r\nO2 (SECOND)\r\nM30\r\n");
  control.pass(seconds(2));
  EXPECT_EQ(control.events(),
            "text \"O0001\\nG0 X1\\n\"\nreceived\nreceiving 2\ntext \"O2 (SECOND)\\nM30\\n\"\n"
            "received\n");
}

TEST(CenturionControl, SplitsAtNothingThatOnlyLooksLikeAnOLine) {
  TestedLine control = receiving("centurion", {{"split_programs", "yes"}});
  control.hear("O1\r\nON ERROR\r\nG0 O2\r\nO12345\r\nM30\r\n");
  control.pass(seconds(2));
  EXPECT_EQ(control.events(), "text \"O1\\nON ERROR\\nG0 O2\\nO12345\\nM30\\n\"\nreceived\n");
}

TEST(CenturionControl, KeepsAllInOneUnlessSetToSplit) {  // CEN-201
  TestedLine control = receiving("centurion");
  control.hear("O1\r\nM30\r\nO2\r\nM30\r\n");
  control.pass(seconds(2));
  EXPECT_EQ(control.events(), "text \"O1\\nM30\\nO2\\nM30\\n\"\nreceived\n");
}

TEST(CenturionControl, DropsLinesThatHoldOnlyAPercentSign) {
  TestedLine control = receiving("centurion");
  control.hear("%\r\nO1\r\nM30\r\n%\r\n");
  control.pass(seconds(2));
  EXPECT_EQ(control.events(), "text \"O1\\nM30\\n\"\nreceived\n");
}

TEST(CenturionControl, EndsAtItsEndOfFileCharacter) {  // CEN-198, CEN-201
  TestedLine control = receiving("centurion", {{"end_char", "SUB"}});
  control.hear("O1\r\nM30\r\n\x1a");
  EXPECT_EQ(control.events(), "text \"O1\\nM30\\n\"\nreceived\n");
}

TEST(CenturionControl, SendsCrAloneOrCrLf) {  // CEN-198, CEN-200
  for (const auto& [eob, expected] :
       {std::pair{"cr"s, "G0\rM30\r"s}, {"crlf"s, "G0\r\nM30\r\n"s}}) {
    TestedLine control(template_with("centurion", {{"eob", eob}}), Role::Control);
    ASSERT_TRUE(control.line->begin_send("", control.now));
    ASSERT_TRUE(control.offer("G0\nM30\n"));
    EXPECT_EQ(control.say(), expected);
  }
}

TEST(CenturionControl, StartsAndStopsTheHostAsItsTapeReader) {  // CEN-199
  TestedLine control(
      template_with("centurion-tape",
                    {{"tape_start", "STX"}, {"tape_stop", "EM"}, {"end_char", "EOT"}}),
      Role::Control);
  ASSERT_TRUE(control.line->begin_receive("", control.now));
  EXPECT_EQ(control.say(), "\x02");
  control.hear("O1\r\nM30\r\n\x04");
  EXPECT_EQ(control.say(), "\x19");
  EXPECT_EQ(control.events(), "receiving\ntext \"O1\\nM30\\n\"\nreceived\n");
}

TEST(CenturionHost, SendsWhenItsTapeStartCharacterComes) {  // CEN-199
  TestedLine host(template_with("centurion-tape", {{"tape_start", "STX"}}), Role::Host);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("M30\n"));
  EXPECT_EQ(host.say_now(), "");
  host.hear("\x02");
  EXPECT_EQ(host.say(), "M30\r\n");
}

TEST(CenturionControl, PutsTapeCharactersAroundWhatItSends) {
  TestedLine control(template_with("centurion", {{"start_char", "DC2"}, {"end_char", "DC4"}}),
                     Role::Control);
  ASSERT_TRUE(control.line->begin_send("", control.now));
  ASSERT_TRUE(control.offer("G0\n"));
  EXPECT_EQ(control.say(), "\x12G0\r\n\x14");
}

TEST(CenturionControl, SendsReportLinesAsTheyCome) {
  TestedLine control = receiving("centurion");
  ASSERT_TRUE(control.line->begin_send("", control.now)) << "DPRNT while it is fed";
  ASSERT_TRUE(control.offer("X 1.0000\n", false));
  EXPECT_EQ(control.say(), "X 1.0000\r\n");
  ASSERT_TRUE(control.offer("X 2.0000\n", false));
  EXPECT_EQ(control.say(), "X 2.0000\r\n");
  ASSERT_TRUE(control.offer("", true));
  control.say();
  EXPECT_THAT(control.events(), HasSubstr("sent"));
}

TEST(CenturionControl, NamesItsErrors) {  // CEN-208
  const std::pair<LineFault, std::string_view> rows[] = {{LineFault::Overrun, "error 900"},
                                                         {LineFault::Parity, "error 901"},
                                                         {LineFault::Framing, "error 902"},
                                                         {LineFault::Break, "error 903"}};
  for (const auto& [fault, says] : rows) {
    TestedLine control = receiving("centurion");
    control.hear("O1\r\n");
    control.hear_fault(fault);
    EXPECT_THAT(control.events(), HasSubstr(std::string(says)));
  }
}

TEST(CenturionControl, OverrunsWhenItsBufferIsFull) {  // CEN-198, CEN-208
  TestedLine control = receiving("centurion", {{"buffer_size", "20"}});
  control.line->set_ready(false, control.now);
  EXPECT_EQ(control.say(), "\x13");
  control.hear("01234567890123456789");
  EXPECT_THAT(control.events(), testing::Not(HasSubstr("failed")));
  control.hear("0");
  EXPECT_THAT(control.events(), HasSubstr("error 900: RS232 overrun, the buffer of 20"));
}

TEST(CenturionControl, NamesASendThatDidNotWork) {  // CEN-208
  TestedLine control(template_with("centurion", {{"hold_limit_ms", "1000"}}), Role::Control);
  ASSERT_TRUE(control.line->begin_send("", control.now));
  control.hear("\x13");
  control.pass(seconds(1));
  EXPECT_THAT(control.events(), HasSubstr("failed timeout: error 319: send aborted"));
}

TEST(CenturionDnc, SkipsBlocksBeforeItRuns) {
  TestedLine control = receiving("centurion", {{"dnc_mode", "run"}, {"dnc_skip", "2"}});
  control.hear("N1 G0\r\nN2 G1\r\nN3 M30\r\n");
  EXPECT_EQ(control.events(), "text \"N3 M30\\n\"\n");
}

TEST(CenturionDnc, DoesNotSplitWhatItRuns) {
  TestedLine control = receiving("centurion", {{"dnc_mode", "verify"}, {"split_programs", "yes"}});
  control.hear("O1\r\nM30\r\nO2\r\n");
  EXPECT_EQ(control.events(), "text \"O1\\nM30\\nO2\\n\"\n");
}

TEST(CenturionDnc, FastTakesNoUnits) {
  for (const std::string_view block : {"N1 G20\r\n", "G021X1\r\n", "G1 X1 G21 "}) {
    TestedLine control = receiving("centurion", {{"dnc_mode", "fast"}});
    control.hear(block);
    EXPECT_THAT(control.events(), HasSubstr("failed unsupported: error 609")) << block;
  }
  for (const std::string_view block :
       {"G0 X20\r\n", "G200\r\n", "(G20)\r\n", "G2 0\r\n", "F20\r\n"}) {
    TestedLine control = receiving("centurion", {{"dnc_mode", "fast"}});
    control.hear(block);
    EXPECT_THAT(control.events(), testing::Not(HasSubstr("failed"))) << block;
  }
}

TEST(CenturionDnc, CannotContinueOverALine) {
  TestedLine control(template_with("centurion", {{"dnc_mode", "continue"}}), Role::Control);
  const auto begun = control.line->begin_receive("", control.now);
  ASSERT_FALSE(begun);
  EXPECT_EQ(begun.error().code, Errc::Unsupported);
}

TEST(CenturionDnc, CannotBeLinkedDuringARun) {  // CEN-208
  TestedLine control = receiving("centurion", {{"dnc_mode", "run"}});
  const auto again = control.line->begin_receive("", control.now);
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, Errc::Busy);
  EXPECT_THAT(again.error().what, HasSubstr("error 415"));
}

}  // namespace
}  // namespace dripline::wire
