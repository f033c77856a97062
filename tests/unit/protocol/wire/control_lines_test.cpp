#include <gmock/gmock.h>

#include "tests/unit/protocol/wire/control_line.hpp"

/// What particular controls do on a plain line: ProtoTRAK Plus, Centurion.
namespace dripline::wire {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test_support::TestedLine;
using testing::HasSubstr;
using namespace std::string_literals;

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
