#include <gmock/gmock.h>

#include "tests/unit/protocol/wire/plain_line.hpp"

/// Plain text held by XON/XOFF, RTS/CTS or pauses, seen from one end.
namespace dripline::wire {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test_support::TestedLine;
using testing::HasSubstr;
using namespace std::string_literals;

TEST(PlainSending, EndsBlocksAsTheLineWants) {
  TestedLine host(settings_with({{"eob", "crlf"}}), Role::Host);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("G0 X1\nM30\n"));
  EXPECT_EQ(host.say(), "G0 X1\r\nM30\r\n");
  EXPECT_EQ(host.events(), "sending\nsent\n");
}

TEST(PlainSending, PutsLeaderMarksAndTrailerAroundTheText) {
  TestedLine host(settings_with({{"leader", "3"},
                                 {"trailer", "2"},
                                 {"start_char", "%"},
                                 {"end_char", "%"},
                                 {"eob", "lf"}}),
                  Role::Host);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("O1\nM30\n"));
  EXPECT_EQ(host.say(), "\0\0\0%\nO1\nM30\n%\0\0"s);
}

TEST(PlainSending, DoublesNoMarkThatTheTextBrings) {
  TestedLine host(settings_with({{"start_char", "%"}, {"end_char", "%"}, {"eob", "lf"}}),
                  Role::Host);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("%\nO1\nM30\n%\n"));
  EXPECT_EQ(host.say(), "%\nO1\nM30\n%");
  EXPECT_EQ(host.line->state().text_sent, 11u) << "the dropped line end counts as sent";
}

TEST(PlainSending, EndsTheLastBlockBeforeAPrintableEndCharacter) {
  TestedLine host(settings_with({{"end_char", "%"}, {"eob", "lf"}}), Role::Host);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("M30"));
  EXPECT_EQ(host.say(), "M30\n%");
}

TEST(PlainSending, RefusesTextAfterItsEndCharacterNamingTheLine) {
  TestedLine host(settings_with({{"end_char", "%"}}), Role::Host);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("G1\n(50", false));
  const auto offered = host.offer("% done)\nM30\n");
  ASSERT_FALSE(offered);
  EXPECT_EQ(offered.error().code, Errc::Syntax);
  EXPECT_THAT(offered.error().what, HasSubstr("line 2"));
  EXPECT_THAT(host.events(), HasSubstr("failed syntax"));
  EXPECT_EQ(host.line->state().phase, Phase::Idle);
}

TEST(PlainSending, RefusesCharactersThatTheCodeDoesNotHave) {
  TestedLine host(settings_with({{"code", "eia"}, {"flow", "rtscts"}}), Role::Host);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  const auto offered = host.offer("G1\nX=2\n");
  ASSERT_FALSE(offered);
  EXPECT_THAT(offered.error().what, HasSubstr("line 2"));
}

TEST(PlainSending, AcceptsNoMoreThanItsRoom) {
  TestedLine host(LineSettings{}, Role::Host);
  EXPECT_EQ(host.line->room(), 0u) << "nothing is being sent";
  ASSERT_TRUE(host.line->begin_send("", host.now));
  const std::size_t room = host.line->room();
  EXPECT_LE(room, 64u * 1024);
  const auto offered = host.offer(std::string(room + 1, 'X'), false);
  ASSERT_FALSE(offered);
  EXPECT_EQ(offered.error().code, Errc::LimitExceeded);
  EXPECT_TRUE(host.offer(std::string(room, 'X'), false));
  EXPECT_EQ(host.line->room(), 0u);
}

TEST(PlainSending, CountsWhatHasLeft) {
  TestedLine host(settings_with({{"eob", "crlf"}}), Role::Host);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("AB\nC\n"));
  EXPECT_EQ(host.say_now(3), "AB\r");
  EXPECT_EQ(host.line->state().text_sent, 2u) << "half an end of block has not left";
  EXPECT_EQ(host.say_now(1), "\n");
  EXPECT_EQ(host.line->state().text_sent, 3u);
}

TEST(PlainSending, StopsAtDc3AndResumesAtDc1) {
  TestedLine host(LineSettings{}, Role::Host);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("ABCDEF\n"));
  EXPECT_EQ(host.say_now(2), "AB");
  host.hear(kDc3);
  EXPECT_EQ(host.say(), "");
  EXPECT_TRUE(host.line->state().is_stopped);
  EXPECT_EQ(host.line->state().waiting_for, "DC1");
  EXPECT_TRUE(host.line->state().may_wait_without_limit);
  host.hear(kDc1);
  EXPECT_EQ(host.say(), "CDEF\r\n");
  EXPECT_EQ(host.events(), "sending\nstopped\nresumed\nsent\n");
}

TEST(PlainSending, IgnoresDc3WhereNothingHoldsTheLine) {
  TestedLine host(settings_with({{"flow", "none"}}), Role::Host);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  host.hear(kDc3);
  ASSERT_TRUE(host.offer("AB\n"));
  EXPECT_EQ(host.say(), "AB\r\n");
}

TEST(PlainSending, StopsWhileCtsIsOff) {
  TestedLine host(settings_with({{"flow", "rtscts"}}), Role::Host);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("AB\n"));
  host.line->lines({.cts = false}, host.now);
  EXPECT_EQ(host.say(), "");
  EXPECT_EQ(host.line->state().waiting_for, "CTS");
  host.line->lines({.cts = true}, host.now);
  EXPECT_EQ(host.say(), "AB\r\n");
}

/// Characters on the line are lost, perhaps in the middle of a block: the rest must not follow.
TEST(PlainSending, EndsWhenDsrGoesOffInTheMiddle) {
  TestedLine host(LineSettings{}, Role::Host);
  host.line->lines({.cts = true, .dsr = true, .dcd = true}, host.now);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("G0 X1\nM30\n", false));
  host.say();
  host.line->lines({.cts = true, .dsr = false, .dcd = true}, host.now);
  EXPECT_THAT(host.events(), HasSubstr("failed timeout: DSR went off"));
  EXPECT_EQ(host.line->state().phase, Phase::Idle);
}

TEST(PlainSending, ContinuesWhereTheCableHasNoDsr) {
  TestedLine host(LineSettings{}, Role::Host);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("G0 X1\n", false));
  host.say();
  host.line->lines({.cts = true, .dsr = false, .dcd = false}, host.now);
  ASSERT_TRUE(host.offer("M30\n"));
  EXPECT_EQ(host.say(), "M30\r\n");
}

TEST(PlainSending, GivesUpWhenHeldLongerThanTheLimit) {
  TestedLine host(settings_with({{"hold_limit_ms", "5000"}}), Role::Host);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("AB\n"));
  host.hear(kDc3);
  EXPECT_FALSE(host.line->state().may_wait_without_limit);
  host.pass(milliseconds(4999));
  EXPECT_EQ(host.line->state().phase, Phase::Sending);
  host.pass(milliseconds(1));
  EXPECT_THAT(host.events(), HasSubstr("failed timeout: the other end held us with DC3 for 5000"));
  EXPECT_EQ(host.line->state().phase, Phase::Idle);
}

TEST(PlainSending, StaysStoppedForTheNextTransferUntilAborted) {
  TestedLine host(LineSettings{}, Role::Host);
  host.hear(kDc3);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("AB\n"));
  EXPECT_EQ(host.say(), "");
  host.line->abort(host.now);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("AB\n"));
  EXPECT_EQ(host.say(), "AB\r\n");
}

TEST(PlainSending, WaitsForTheControlsDc1WhenSet) {
  TestedLine host(settings_with({{"wait_for_xon", "yes"}}), Role::Host);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("AB\n"));
  EXPECT_EQ(host.say_now(), "");
  EXPECT_EQ(host.line->state().waiting_for, "DC1");
  host.hear(kDc1);
  EXPECT_EQ(host.say(), "AB\r\n");
}

TEST(PlainSending, FailsWhenNoDc1ComesInTime) {
  TestedLine host(settings_with({{"wait_for_xon", "yes"}, {"start_limit_ms", "700"}}), Role::Host);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  host.pass(milliseconds(700));
  EXPECT_THAT(host.events(), HasSubstr("failed timeout: no DC1 came to start for 700 ms"));
}

TEST(PlainSending, StartsAtOnceWhenDc1CameFirst) {
  TestedLine host(settings_with({{"wait_for_xon", "yes"}}), Role::Host);
  host.hear(kDc1);
  EXPECT_EQ(host.events(), "resumed\nwants a program\n");
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("AB\n"));
  EXPECT_EQ(host.say(), "AB\r\n");
}

TEST(PlainSending, UsesUpTheDc1ThatWasRefused) {
  TestedLine host(settings_with({{"wait_for_xon", "yes"}}), Role::Host);
  host.hear(kDc1);
  ASSERT_TRUE(host.line->refuse("", host.now));
  host.events();
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("AB\n"));
  EXPECT_EQ(host.say_now(), "");
  host.hear(kDc1);
  EXPECT_EQ(host.say(), "AB\r\n");
}

TEST(PlainSending, PausesAfterBlocksAndCharacters) {
  TestedLine host(
      settings_with(
          {{"flow", "none"}, {"line_delay_ms", "100"}, {"char_delay_us", "2000"}, {"eob", "lf"}}),
      Role::Host);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  ASSERT_TRUE(host.offer("A\nB\n"));
  const LineTime character = character_time(LineSettings{});
  EXPECT_EQ(host.say_now(), "A");
  host.pass(character + milliseconds(2));
  EXPECT_EQ(host.say_now(), "\n");
  host.pass(character + milliseconds(101));
  EXPECT_EQ(host.say_now(), "") << "the pause after a block is 102 ms";
  host.pass(milliseconds(1));
  EXPECT_EQ(host.say_now(), "B");
}

TEST(PlainSending, IsBusyWhileSending) {
  TestedLine host(LineSettings{}, Role::Host);
  ASSERT_TRUE(host.line->begin_send("", host.now));
  const auto again = host.line->begin_send("", host.now);
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, Errc::Busy);
}

TEST(PlainSettings, RefuseMarksThatTheLineCannotCarry) {
  const auto refused =
      [](std::initializer_list<std::pair<std::string_view, std::string_view>> set) {
        const auto made = make_discipline(settings_with(set), Role::Host);
        return made ? std::string() : made.error().what;
      };
  EXPECT_THAT(refused({{"end_char", "DC3"}}), HasSubstr("end_char DC3: it steers"));
  EXPECT_THAT(refused({{"flow", "dc_codes"}, {"start_char", "DC2"}}), HasSubstr("start_char DC2"));
  EXPECT_THAT(refused({{"flow", "rtscts"}, {"code", "eia"}, {"end_char", "ETX"}}),
              HasSubstr("the code"));
  EXPECT_EQ(refused({{"flow", "rtscts"}, {"code", "eia"}, {"end_char", "%"}}), "");
  EXPECT_EQ(refused({{"start_char", "DC2"}, {"end_char", "DC4"}}), "");
}

}  // namespace
}  // namespace dripline::wire
