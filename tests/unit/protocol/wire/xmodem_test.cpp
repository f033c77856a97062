#include <gmock/gmock.h>

#include "protocol/wire/impl/xmodem_block.hpp"
#include "tests/support/line/line_events.hpp"

/// XMODEM, checksum and CRC, sender and receiver, each from one end.
namespace dripline::wire {
namespace {

using std::chrono::seconds;
using test_support::TestedLine;
using testing::HasSubstr;
using xmodem::Check;

const std::string kEot = "\x04", kAck = "\x06", kNak = "\x15", kCan = "\x18";
const std::string kTwoCans = kCan + kCan, kFiveCans = kTwoCans + kTwoCans + kCan;

LineSettings xmodem_line(Check check = Check::Crc) {
  LineSettings settings;
  settings.flow = Flow::Xmodem;
  settings.end_of_block = EndOfBlock::Lf;
  settings.xmodem_crc = check == Check::Crc;
  settings.retries = 3;
  return settings;
}

std::string block(unsigned number, std::string_view data, Check check = Check::Crc) {
  const auto bytes =
      xmodem::make_block(static_cast<std::uint8_t>(number), std::as_bytes(std::span(data)), check);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TestedLine sender(const LineSettings& settings, std::string_view text) {
  TestedLine line(settings, Role::Host);
  EXPECT_TRUE(line.line->begin_send("", line.now));
  EXPECT_TRUE(line.offer(text));
  line.events();
  return line;
}

TestedLine receiver(const LineSettings& settings) {
  TestedLine line(settings, Role::Control);
  EXPECT_TRUE(line.line->begin_receive("", line.now));
  line.events();
  return line;
}

/// What the receiver says to a block, once it is sure that nothing follows.
std::string answer(TestedLine& line) {
  line.pass(std::chrono::milliseconds(10));
  return line.say_now();
}

TEST(XmodemBlock, HasTheCheckValuesOfTheProtocol) {
  const std::string_view digits = "123456789";
  EXPECT_EQ(xmodem::crc16(std::as_bytes(std::span(digits))), 0x31c3);
  EXPECT_EQ(xmodem::checksum(std::as_bytes(std::span(digits))), 0xdd);
  EXPECT_EQ(block(1, "", Check::Sum).size(), 132u);
  EXPECT_EQ(block(1, "").size(), 133u);
}

TEST(XmodemSender, SendsBlocksUntilAllAreAccepted) {
  const std::string text(200, 'X');
  TestedLine line = sender(xmodem_line(), text);
  EXPECT_EQ(line.say_now(), "") << "the receiver begins";
  line.hear("C");
  EXPECT_EQ(line.say_now(), block(1, text.substr(0, 128)));
  line.hear(kAck);
  EXPECT_EQ(line.say_now(), block(2, text.substr(128)));
  line.hear(kAck);
  EXPECT_EQ(line.say_now(), kEot);
  line.hear(kNak);
  EXPECT_EQ(line.say_now(), kEot);
  line.hear(kAck);
  EXPECT_EQ(line.events(), "accepted 128\naccepted 200\nsent\n");
}

TEST(XmodemSender, UsesTheChecksumForAReceiverThatSendsNak) {
  TestedLine line = sender(xmodem_line(), "M30\n");
  line.hear(kNak);
  EXPECT_EQ(line.say_now(), block(1, "M30\n", Check::Sum));
}

TEST(XmodemSender, RepeatsARefusedBlockAndGivesUpAfterItsRetries) {
  TestedLine line = sender(xmodem_line(), "M30\n");
  line.hear("C");
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(line.say_now(), block(1, "M30\n"));
    line.hear(kNak);
  }
  EXPECT_THAT(line.events(), HasSubstr("failed corrupt: block 1 was refused 4 times"));
  EXPECT_EQ(line.say_now(), kFiveCans);
}

TEST(XmodemSender, TakesNoAnswerForABlockThatHasNotLeft) {
  TestedLine line = sender(xmodem_line(), std::string(300, 'X'));
  line.hear("C");
  line.say_now();
  line.hear(kAck + kAck);
  EXPECT_EQ(line.say_now(), block(2, std::string(128, 'X')));
  line.hear(kAck);
  EXPECT_EQ(line.say_now(), block(3, std::string(44, 'X')));
}

TEST(XmodemSender, TakesNoAnswerForAnEndThatHasNotLeft) {
  TestedLine line = sender(xmodem_line(), "M30\n");
  line.hear("C");
  line.say_now();
  line.hear(kAck + kAck);
  EXPECT_EQ(line.events(), "accepted 4\n");
  EXPECT_EQ(line.say_now(), kEot);
}

TEST(XmodemSender, CountsABlockEndAcrossTwoBlocksWithTheSecond) {
  LineSettings settings = xmodem_line();
  settings.end_of_block = EndOfBlock::CrLf;
  TestedLine line = sender(settings, std::string(127, 'X') + "\nM30\n");
  line.hear("C");
  line.say_now();
  EXPECT_EQ(line.line->state().text_sent, 127u);
  line.hear(kAck);
  EXPECT_EQ(line.events(), "accepted 127\n");
  EXPECT_EQ(line.say_now(), block(2, "\nM30\r\n"));
  line.hear(kAck);
  EXPECT_EQ(line.events(), "accepted 132\n");
}

TEST(XmodemSender, WaitsForTextToFillABlock) {
  TestedLine line(xmodem_line(), Role::Host);
  ASSERT_TRUE(line.line->begin_send("", line.now));
  ASSERT_TRUE(line.offer(std::string(100, 'X'), false));
  line.hear("C");
  EXPECT_EQ(line.say_now(), "");
  ASSERT_TRUE(line.offer(std::string(28, 'X'), false));
  EXPECT_EQ(line.say_now(), block(1, std::string(128, 'X')));
  line.hear(kAck);
  EXPECT_EQ(line.say_now(), "");
  ASSERT_TRUE(line.offer("", true));
  EXPECT_EQ(line.say_now(), kEot);
}

TEST(XmodemSender, FollowsAReceiverThatChangesItsMindBeforeTheFirstBlock) {
  TestedLine line(xmodem_line(), Role::Host);
  ASSERT_TRUE(line.line->begin_send("", line.now));
  line.hear("CCCC" + kNak);
  ASSERT_TRUE(line.offer("M30\n"));
  EXPECT_EQ(line.say_now(), block(1, "M30\n", Check::Sum));
}

TEST(XmodemSender, SendsOnlyTheEndOfAnEmptyProgram) {
  TestedLine line = sender(xmodem_line(), "");
  line.hear("C");
  EXPECT_EQ(line.say_now(), kEot);
}

TEST(XmodemSender, StopsWhenTheReceiverCancels) {
  TestedLine line = sender(xmodem_line(), "M30\n");
  line.hear("C");
  line.say_now();
  line.hear(kCan);
  EXPECT_EQ(line.events(), "");
  line.hear(kCan);
  EXPECT_THAT(line.events(), HasSubstr("failed denied: the other end canceled"));
  EXPECT_EQ(line.say_now(), "");
}

TEST(XmodemSender, WaitsForTheReceiverAsLongAsItsLimit) {
  TestedLine patient = sender(xmodem_line(), "M30\n");
  EXPECT_TRUE(patient.line->state().awaits_start);
  EXPECT_TRUE(patient.line->state().may_wait_without_limit);
  patient.pass(std::chrono::hours(1));
  patient.hear("C");
  EXPECT_EQ(patient.say_now(), block(1, "M30\n"));
  LineSettings settings = xmodem_line();
  settings.start_limit = seconds(60);
  TestedLine line = sender(settings, "M30\n");
  line.pass(seconds(60));
  EXPECT_THAT(line.events(), HasSubstr("failed timeout: the receiver did not ask"));
}

TEST(XmodemSender, AbortNotifiesTheReceiver) {
  TestedLine line = sender(xmodem_line(), "M30\n");
  line.line->abort(line.now);
  EXPECT_EQ(line.say_now(), kFiveCans);
  EXPECT_EQ(line.line->state().phase, Phase::Idle);
}

TEST(XmodemHost, HearsThatAControlWantsAProgram) {
  TestedLine line(xmodem_line(), Role::Host);
  line.hear("C");
  line.hear("C");
  EXPECT_EQ(line.events(), "wants a program\n");
  ASSERT_TRUE(line.line->begin_send("", line.now));
  ASSERT_TRUE(line.offer("M30\n"));
  EXPECT_EQ(line.say_now(), block(1, "M30\n"));
}

TEST(XmodemHost, KeepsARequestWhileTheReceiverAsks) {
  TestedLine line(xmodem_line(), Role::Host);
  for (int i = 0; i < 5; ++i) {
    line.hear("C");
    line.pass(seconds(3));
  }
  EXPECT_EQ(line.say_now(), "") << "there was no command";
  EXPECT_TRUE(line.line->state().is_asked);
  ASSERT_TRUE(line.line->begin_send("", line.now));
  ASSERT_TRUE(line.offer("M30\n"));
  EXPECT_EQ(line.say_now(), "") << "it may have given up since";
  line.hear("C");
  EXPECT_EQ(line.say_now(), block(1, "M30\n"));
}

TEST(XmodemHost, DropsTheRequestOfAReceiverThatIsSilent) {
  TestedLine line(xmodem_line(), Role::Host);
  line.hear("C");
  line.pass(seconds(15));
  EXPECT_FALSE(line.line->state().is_asked);
  EXPECT_FALSE(line.line->deadline());
  line.hear("C");
  EXPECT_EQ(line.events(), "wants a program\nwants a program\n") << "each sequence is reported";
}

TEST(XmodemHost, RefusesByCanceling) {
  TestedLine line(xmodem_line(), Role::Host);
  line.hear("C");
  ASSERT_TRUE(line.line->refuse("no such program", line.now));
  EXPECT_EQ(line.say_now(), kFiveCans);
  EXPECT_FALSE(line.line->refuse("again", line.now));
}

TEST(XmodemReceiver, AsksForCrcThenForTheChecksum) {
  TestedLine line = receiver(xmodem_line());
  std::string asked = line.say_now();
  for (int i = 0; i < 4; ++i) {
    line.pass(seconds(3));
    asked += line.say_now();
  }
  EXPECT_EQ(asked, "CCCC" + kNak);
  line.hear(block(1, "M30\n", Check::Sum));
  EXPECT_EQ(answer(line), kAck);
}

TEST(XmodemReceiver, TakesBlocksAndDropsThePadding) {
  TestedLine line = receiver(xmodem_line());
  EXPECT_EQ(line.say_now(), "C");
  line.hear(block(1, "G0\r\nM30\r\n"));
  EXPECT_EQ(answer(line), kAck);
  line.hear(kEot);
  EXPECT_EQ(line.say_now(), "") << "a lone character may be the rest of a damaged block";
  line.pass(seconds(1));
  EXPECT_EQ(line.say_now(), kNak);
  line.hear(kEot);
  EXPECT_EQ(line.say_now(), kAck);
  EXPECT_EQ(line.events(), "text \"G0\\nM30\\n\"\nreceived\n");
}

TEST(XmodemReceiver, RefusesADamagedBlockOnceTheLineIsSilent) {
  TestedLine line = receiver(xmodem_line());
  line.say_now();
  line.hear(block(1, "G0\n"));
  EXPECT_EQ(answer(line), kAck);
  std::string damaged = block(2, "M30\n");
  damaged[10] ^= 1;
  line.hear(damaged);
  EXPECT_EQ(line.say_now(), "");
  line.pass(seconds(1));
  EXPECT_EQ(line.say_now(), kNak);
  line.hear(block(2, "M30\n"));
  EXPECT_EQ(answer(line), kAck);
  EXPECT_EQ(line.events(), "text \"G0\\nM30\\n\"\n");
}

TEST(XmodemReceiver, RefusesABlockWithALineFault) {
  TestedLine line = receiver(xmodem_line());
  line.say_now();
  const std::string good = block(1, "G0\n");
  line.hear(good.substr(0, 50));
  line.hear_fault(LineFault::Parity);
  line.hear(good.substr(51));
  line.pass(seconds(1));
  EXPECT_EQ(line.say_now(), "C");
  EXPECT_EQ(line.events(), "");
}

TEST(XmodemReceiver, RefusesABlockThatBreaksOff) {
  TestedLine line = receiver(xmodem_line());
  line.say_now();
  line.hear(block(1, "G0\n").substr(0, 100));
  line.pass(seconds(1));
  EXPECT_EQ(line.say_now(), "C");
}

TEST(XmodemReceiver, AcceptsARepeatedBlockWithoutItsText) {
  TestedLine line = receiver(xmodem_line());
  line.say_now();
  line.hear(block(1, "G0\n"));
  EXPECT_EQ(answer(line), kAck);
  line.hear(block(1, "G0\n"));
  EXPECT_EQ(answer(line), kAck);
  EXPECT_EQ(line.events(), "text \"G0\\n\"\n");
}

TEST(XmodemReceiver, RefusesABlockThatACharacterFollows) {
  TestedLine line = receiver(xmodem_line());
  line.say_now();
  line.hear(block(1, "G0\n") + "X");
  line.pass(seconds(1));
  EXPECT_EQ(line.say_now(), "C");
  EXPECT_EQ(line.events(), "");
}

TEST(XmodemReceiver, StopsAtABlockOutOfOrder) {
  TestedLine line = receiver(xmodem_line());
  line.say_now();
  line.hear(block(1, "G0\n"));
  answer(line);
  line.hear(block(3, "M30\n"));
  line.pass(std::chrono::milliseconds(10));
  EXPECT_THAT(line.events(), HasSubstr("failed corrupt: block 3 came where block 2 belongs"));
  EXPECT_EQ(line.say_now(), kFiveCans);
}

TEST(XmodemReceiver, TakesNoEndFromTheRestOfADamagedBlock) {
  TestedLine line = receiver(xmodem_line());
  line.say_now();
  for (unsigned number = 1; number < 4; ++number) {
    line.hear(block(number, "G0\n"));
    answer(line);
  }
  answer(line);
  line.hear(block(4, "M30\n").substr(1));  // its number is EOT
  line.pass(seconds(1));
  EXPECT_EQ(line.say_now(), kNak);
  line.hear(block(4, "M30\n"));
  EXPECT_EQ(answer(line), kAck);
  EXPECT_EQ(line.events(), "text \"G0\\nG0\\nG0\\nM30\\n\"\n");
}

TEST(XmodemReceiver, AcceptsTheEndAgainWhenItsAnswerWasLost) {
  TestedLine line = receiver(xmodem_line());
  line.hear(block(1, "G0\n"));
  answer(line);
  line.hear(kEot);
  line.pass(seconds(1));
  line.hear(kEot);
  line.say_now();
  line.hear(kEot);
  EXPECT_EQ(line.say_now(), kAck);
}

TEST(XmodemReceiver, WithholdsItsAnswerWhileThereIsNoRoom) {
  TestedLine line = receiver(xmodem_line());
  line.say_now();
  line.line->set_ready(false, line.now);
  line.hear(block(1, "G0\n"));
  line.pass(seconds(300));
  EXPECT_EQ(line.say_now(), "");
  EXPECT_EQ(line.line->state().phase, Phase::Receiving);
  line.line->set_ready(true, line.now);
  EXPECT_EQ(line.say_now(), kAck);
}

TEST(XmodemReceiver, AsksAgainForALostBlockThenGivesUp) {
  TestedLine line = receiver(xmodem_line());
  line.hear(block(1, "G0\n"));
  answer(line);
  std::string asked;
  for (int i = 0; i < 4; ++i) {
    line.pass(seconds(10));
    asked += line.say_now();
  }
  EXPECT_EQ(asked, kNak + kNak + kNak + kFiveCans);
  EXPECT_THAT(line.events(), HasSubstr("failed corrupt: block 2 did not come right"));
}

TEST(XmodemReceiver, GivesUpOnALineThatNeverFallsSilent) {
  TestedLine line = receiver(xmodem_line());
  line.hear(block(1, "G0\n"));
  answer(line);
  for (int i = 0; i < 700 && line.line->state().phase == Phase::Receiving; ++i) {
    line.hear("X");
    line.pass(std::chrono::milliseconds(100));
  }
  EXPECT_THAT(line.events(), HasSubstr("failed corrupt: what comes is no XMODEM"));
}

TEST(XmodemReceiver, TakesLongBlocks) {
  TestedLine line = receiver(xmodem_line());
  line.say_now();
  std::string data(1024, 'X');
  const std::uint16_t crc = xmodem::crc16(std::as_bytes(std::span(data)));
  line.hear("\x02\x01\xfe" + data + static_cast<char>(crc >> 8) + static_cast<char>(crc & 0xff));
  EXPECT_EQ(answer(line), kAck);
}

}  // namespace
}  // namespace dripline::wire
