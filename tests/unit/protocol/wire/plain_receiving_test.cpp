#include <gmock/gmock.h>

#include "tests/unit/protocol/wire/plain_line.hpp"

/// Plain text received, and the other end held by XON/XOFF or RTS/CTS.
namespace dripline::wire {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test_support::TestedLine;
using testing::HasSubstr;
using namespace std::string_literals;

TEST(PlainReceiving, BeginsByItselfAtAHostAndEndsWithSilence) {
  TestedLine host(settings_with({{"idle_end_ms", "1500"}}), Role::Host);
  host.hear("\0\0\r\nO1\r\nM30\r\n"s);
  host.pass(milliseconds(1499));
  EXPECT_EQ(host.events(), "receiving\ntext \"O1\\nM30\\n\"\n");
  host.pass(milliseconds(1));
  EXPECT_EQ(host.events(), "received\n");
}

bool is_cut(wire::Discipline& line) {
  for (const auto& event : line.take_events()) {
    if (const auto* ended = std::get_if<TransferEnded>(&event)) return ended->is_cut;
  }
  ADD_FAILURE() << "it did not end";
  return false;
}

TEST(PlainReceiving, SaysWhetherSilenceEndedIt) {
  TestedLine silent(LineSettings{}, Role::Host);
  silent.hear("D 40.0");
  silent.pass(milliseconds(2000));
  EXPECT_TRUE(is_cut(*silent.line));
  TestedLine ended(settings_with({{"end_char", "ETX"}, {"flow", "none"}}), Role::Host);
  ended.hear("D 40.0\x03");
  EXPECT_FALSE(is_cut(*ended.line));
}

TEST(PlainReceiving, EndsAtTheEndCharacter) {
  TestedLine host(settings_with({{"start_char", "DC2"}, {"end_char", "ETX"}, {"flow", "none"}}),
                  Role::Host);
  host.hear(
      "\x12"
      "O1\r\n\x03\0\0"s);
  EXPECT_EQ(host.events(), "receiving\ntext \"O1\\n\"\nreceived\n");
}

TEST(PlainReceiving, ReportsAMissingStartCharacter) {
  TestedLine host(settings_with({{"start_char", "%"}, {"end_char", "%"}}), Role::Host);
  host.hear("O1\r\n%");
  EXPECT_THAT(host.events(), HasSubstr("error corrupt: the start character before the program"));
}

TEST(PlainReceiving, KeepsATitleAfterTheStartCharacter) {
  TestedLine host(settings_with({{"start_char", "%"}, {"end_char", "%"}}), Role::Host);
  host.hear("%:PART 7\r\nO1\r\n%\r\n");
  EXPECT_EQ(host.events(), "receiving\ntext \"%:PART 7\\nO1\\n\"\nreceived\n");
}

TEST(PlainReceiving, FailsWhenTheEndCharacterDoesNotCome) {
  TestedLine host(settings_with({{"end_char", "%"}, {"pause_limit_ms", "3000"}}), Role::Host);
  host.hear("O1\r\n");
  host.pass(seconds(3));
  EXPECT_THAT(host.events(), HasSubstr("failed timeout: the end character did not come"));
}

TEST(PlainReceiving, ReplacesABadCharacterByAQuestionMarkAndReportsItsPlace) {
  TestedLine host(LineSettings{}, Role::Host);
  host.hear("G1\r\nX");
  host.hear_fault(LineFault::Parity);
  host.hear("5\r\n");
  EXPECT_EQ(host.events(),
            "receiving\ntext \"G1\\nX\"\nerror corrupt: line 2, column 2: parity error\n"
            "text \"?5\\n\"\n");
}

TEST(PlainReceiving, HoldsTheOtherEndWithDc3) {
  TestedLine control(LineSettings{}, Role::Control);
  ASSERT_TRUE(control.line->begin_receive("", control.now));
  EXPECT_EQ(control.say(), kDc1);
  control.line->set_ready(false, control.now);
  EXPECT_EQ(control.say_now(), kDc3);
  EXPECT_TRUE(control.line->state().is_stopping);
  control.line->set_ready(true, control.now);
  EXPECT_EQ(control.say_now(), kDc1);
}

TEST(PlainReceiving, RepeatsDc3ToASenderThatContinues) {
  TestedLine control(LineSettings{}, Role::Control);
  ASSERT_TRUE(control.line->begin_receive("", control.now));
  control.line->set_ready(false, control.now);
  control.say_now();
  control.hear(std::string(15, 'X'));
  EXPECT_EQ(control.say_now(), "");
  control.hear("X");
  EXPECT_EQ(control.say_now(), kDc3);
}

TEST(PlainReceiving, RepeatsDc1ToASenderThatStaysSilent) {
  TestedLine control(LineSettings{}, Role::Control);
  ASSERT_TRUE(control.line->begin_receive("", control.now));
  control.line->set_ready(false, control.now);
  control.line->set_ready(true, control.now);
  EXPECT_EQ(control.say_now(), kDc1 + kDc3 + kDc1);
  control.pass(seconds(1));
  EXPECT_EQ(control.say_now(), kDc1);
  control.pass(seconds(60));
  EXPECT_EQ(control.say_now(), "");
}

TEST(PlainReceiving, ReportsMissingEndsOfBlock) {
  TestedLine host(LineSettings{}, Role::Host);
  host.hear("G1\r\n" + std::string(1024, 'X'));
  EXPECT_THAT(host.events(), testing::Not(HasSubstr("error ")));
  host.hear("XX");
  EXPECT_THAT(host.events(), HasSubstr("error corrupt: line 2 is longer than 1024 characters"));
}

TEST(PlainReceiving, HoldsTheOtherEndWithRts) {
  TestedLine control(settings_with({{"flow", "rtscts"}}), Role::Control);
  control.line->set_ready(false, control.now);
  EXPECT_FALSE(control.line->output_lines().rts);
  control.line->set_ready(true, control.now);
  EXPECT_TRUE(control.line->output_lines().rts);
  EXPECT_EQ(control.say_now(), "");
}

TEST(PlainReceiving, DoesNotTakeItsOwnHoldForTheEnd) {
  TestedLine control(LineSettings{}, Role::Control);
  ASSERT_TRUE(control.line->begin_receive("", control.now));
  control.hear("G1\r\n");
  control.line->set_ready(false, control.now);
  control.pass(seconds(60));
  EXPECT_EQ(control.line->state().phase, Phase::Receiving);
  control.line->set_ready(true, control.now);
  control.pass(seconds(2));
  EXPECT_THAT(control.events(), HasSubstr("received"));
}

TEST(PlainReceiving, ReceivesNothingAtAControlWithoutACommand) {
  TestedLine control(LineSettings{}, Role::Control);
  control.hear("G1\r\n");
  EXPECT_EQ(control.events(), "");
}

TEST(PlainReceiving, ContinuesWhileTheHostFeeds) {
  TestedLine host(LineSettings{}, Role::Host);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("G1\n", false));
  EXPECT_EQ(host.say_now(), "G1\r\n");
  host.hear("LINE 1\r\n");
  host.pass(seconds(2));
  EXPECT_EQ(host.line->state().phase, Phase::Sending);
  ASSERT_TRUE(host.offer("M30\n"));
  EXPECT_EQ(host.say(), "M30\r\n");
  EXPECT_EQ(host.events(), "sending\nreceiving\ntext \"LINE 1\\n\"\nreceived\nsent\n");
}

}  // namespace
}  // namespace dripline::wire
