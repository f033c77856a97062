#include <thread>

#include "gateway/app/panel/panel_controller.hpp"
#include "tests/unit/gateway/app/serial/line_answers_fixture.hpp"

/// What the server wants of a gateway's line.
namespace dripline::gateway {
namespace {

using namespace std::chrono_literals;

TEST_F(LineAnswersTest, TestsTheLineAgainAfterATestThatNobodyAskedForAgain) {
  begin(kPlain);
  EXPECT_EQ(ask_once(request(LineAction::Test, "first")).status, LineResult::NotYet);
  let_time_pass();
  EXPECT_EQ(ask_once(request(LineAction::Test, "second")).status, LineResult::NotYet);
  let_time_pass();
  const auto test = line::decode_port_test(text_of(ask_once(request(LineAction::Test, "second"))));
  ASSERT_TRUE(test);
  EXPECT_TRUE(test->is_passed) << testing::PrintToString(test->findings);
}

/// What is asked for between two questions for the same test does not begin it again.
TEST_F(LineAnswersTest, KeepsATestAndWhatItFoundApartFromOtherRequests) {
  begin(kPlain);
  EXPECT_EQ(ask_once(request(LineAction::Test, "test")).status, LineResult::NotYet);
  EXPECT_EQ(ask_once(request(LineAction::Test, "other")).reason, "the line is being tested");
  EXPECT_EQ(ask_once(request(LineAction::Done, "done")).status, LineResult::Done);
  EXPECT_EQ(ask_once(request(LineAction::Test, "test")).status, LineResult::NotYet);
  let_time_pass();
  EXPECT_EQ(ask_once(request(LineAction::Done, "done-2")).status, LineResult::Done);
  for (int i = 0; i < 2; ++i) {
    const auto answer = ask_once(request(LineAction::Test, "test"));
    ASSERT_EQ(answer.status, LineResult::Done) << answer.reason;
    EXPECT_TRUE(line::decode_port_test(text_of(answer)));
  }
}

/// Requests of several callers come in between each other, and each more than once.
TEST_F(LineAnswersTest, DoesEachOnceAlsoWhenAnotherCameInBetween) {
  begin(kPlain);
  ASSERT_EQ(send(program_).status, LineResult::Done);
  auto order = request(LineAction::Send, "again");
  order.name = "transfer-1";
  order.text = line::encode(line::TransferOrder{});
  EXPECT_EQ(ask_once(order).reason, "the text of this transfer is not here");
  ASSERT_TRUE(
      pass_until([&] { return transfer().state == dds::LineTransferState::Completed; }, 60s));
  auto text = request(LineAction::Text, "text");
  text.name = "transfer-2";
  text.bytes = {std::byte{'M'}};
  EXPECT_EQ(ask_once(text).status, LineResult::Done);
  EXPECT_EQ(ask_once(order).reason, "the text of this transfer is not here") << "as before";
  EXPECT_EQ(ask_once(text).status, LineResult::Done);
}

TEST_F(LineAnswersTest, SendsProgramsToTheControlWithoutARun) {
  begin(kPlain);
  const auto begun = send(program_);
  ASSERT_EQ(begun.status, LineResult::Done) << begun.reason;
  EXPECT_EQ(transfer().id, "transfer-1");
  EXPECT_EQ(transfer().programs, "O0077 revision 1");
  EXPECT_EQ(transfer().size, program_.size());
  EXPECT_EQ(status().run, "");
  connect(false);  // all of it is here
  ASSERT_TRUE(
      pass_until([&] { return transfer().state == dds::LineTransferState::Completed; }, 60s));
  EXPECT_EQ(wire_.sent, program_);
  EXPECT_EQ(transfer().sent, program_.size());
  EXPECT_TRUE(records_.empty()) << "it is no run";
  auto look = request(LineAction::Recording);
  EXPECT_NE(text_of(ask(look)).find("the transfer of programs completed"), std::string::npos);
}

TEST_F(LineAnswersTest, StopsATransfer) {
  begin(kPlain);
  EXPECT_EQ(stop("by who").status, LineResult::Refused) << "there is nothing";
  ASSERT_EQ(send(program_).status, LineResult::Done);
  pass(1s);
  EXPECT_EQ(stop("stopped by who").status, LineResult::Done);
  ASSERT_TRUE(pass_until([&] { return transfer().state == dds::LineTransferState::Aborted; }, 5s));
  EXPECT_NE(transfer().reason.find("stopped by who"), std::string::npos);
  pass(2s);
  EXPECT_LT(wire_.sent.size(), program_.size());
}

/// It would take the next program for the answer's rest.
TEST_F(LineAnswersTest, CutsOffNoAnswerThatTheControlIsReading) {
  begin(kPlain);
  ASSERT_EQ(give(program_).status, LineResult::Done);
  pass(1s);
  EXPECT_EQ(transfer().programs, "the answer O0077");
  EXPECT_EQ(transfer().state, dds::LineTransferState::Sending);
  order("G0 X1\n");
  ASSERT_TRUE(result_);
  EXPECT_FALSE(result_->accepted);
  EXPECT_NE(result_->reason.find("its control reads what it asked for"), std::string::npos)
      << result_->reason;
  EXPECT_EQ(send(program_).status, LineResult::Refused);
  ASSERT_TRUE(pass_until([&] { return !status().serial_line->transfer; }, 60s));
  EXPECT_EQ(wire_.sent, program_);
  EXPECT_EQ(send(program_).status, LineResult::Done);
}

TEST_F(LineAnswersTest, ShowsAnAnswerThatWasCutOff) {
  begin(kPlain);
  ASSERT_EQ(give(program_).status, LineResult::Done);
  pass(1s);
  EXPECT_EQ(stop("stopped by who").status, LineResult::Done);
  ASSERT_TRUE(pass_until([&] { return transfer().state == dds::LineTransferState::Aborted; }, 5s));
  EXPECT_EQ(transfer().programs, "the answer O0077");
  EXPECT_GT(transfer().sent, 0u);
}

TEST_F(LineAnswersTest, SendsNoTextThatIsNotWhatTheServerHas) {
  begin(kPlain);
  const auto refused = send(program_, sha256("another").hex());
  EXPECT_EQ(refused.reason, "the text is not what the server states");
  pass(2s);
  EXPECT_EQ(wire_.sent, "");
  // A piece that is missing, and one of another text between.
  auto part = request(LineAction::Text);
  part.name = "transfer-2";
  part.number = 1000;
  part.bytes = {std::byte{'G'}};
  EXPECT_EQ(ask(part).status, LineResult::Refused);
  part.number = 0;
  EXPECT_EQ(ask(part).status, LineResult::Done);
  part.name = "transfer-3";
  EXPECT_EQ(ask(part).reason, "the text of another transfer is just coming");
  clock_.advance(SerialTransfer::kPatience);
  EXPECT_EQ(ask(part).status, LineResult::Done);
}

TEST_F(LineAnswersTest, SendsNothingBesideARunOrWhileTheEmergencyStopIsPressed) {
  begin(kPlain);
  EXPECT_EQ(panel("emergency-stop on"), "ok");
  EXPECT_EQ(send(program_).reason, kEmergencyStopIsPressed);
  EXPECT_EQ(panel("emergency-stop off"), "ok");
  start(program_);
  EXPECT_EQ(send(program_).reason, "a run is on the line");
  EXPECT_EQ(stop("by who").status, LineResult::Refused) << "a run is aborted as one";
  ASSERT_TRUE(pass_until([&] { return ended().has_value(); }, 60s));
  ASSERT_EQ(send(program_).status, LineResult::Done);
  EXPECT_EQ(panel("emergency-stop on"), "ok");
  ASSERT_TRUE(pass_until([&] { return transfer().state == dds::LineTransferState::Aborted; }, 5s));
  EXPECT_NE(transfer().reason.find("EMERGENCY STOP"), std::string::npos);
}

/// A control that happens to be in its DNC mode executes what comes.
TEST_F(LineAnswersTest, AtAnAttendedMachineATransferNeedsItsOperatorsConsent) {
  options_.is_unattended = false;
  begin(kPlain);
  const auto refused = send(program_);
  EXPECT_EQ(refused.status, LineResult::Refused);
  EXPECT_NE(refused.reason.find("remote-enable on"), std::string::npos) << refused.reason;
  pass(2s);
  EXPECT_EQ(wire_.sent, "");
  EXPECT_EQ(panel("remote-enable on"), "ok");
  EXPECT_EQ(send(program_).status, LineResult::Done);
  pass(1s);
  EXPECT_EQ(panel("abort"), "ok");
  ASSERT_TRUE(pass_until([&] { return transfer().state == dds::LineTransferState::Aborted; }, 5s));
}

TEST_F(LineAnswersTest, TheControlsRequestAfterItIsConsentAndBeforeItIsNone) {
  options_.is_unattended = false;
  begin("line=9600n81\neob=lf\nflow=dc_codes");
  line_->receive("\x11");
  pass(200ms);
  EXPECT_NE(send(program_).reason.find("has asked before this"), std::string::npos);
  line_->receive("\x13");
  pass(200ms);
  ASSERT_EQ(send(program_).status, LineResult::Done);
  pass(2s);
  EXPECT_EQ(wire_.sent, "") << "it waits for the control";
  line_->receive("\x11");
  ASSERT_TRUE(
      pass_until([&] { return transfer().state == dds::LineTransferState::Completed; }, 60s));
}

/// Its control still waits for the rest.
TEST_F(LineAnswersTest, ATextThatWasBrokenOffOutlivesTheGateway) {
  begin(kPlain);
  ASSERT_EQ(send(program_).status, LineResult::Done);
  pass(1s);
  const auto left = wire_.sent.size();
  ASSERT_GT(left, 0u);
  kill();
  begin(kPlain);
  EXPECT_EQ(transfer().state, dds::LineTransferState::Interrupted);
  EXPECT_EQ(transfer().id, "transfer-1");
  EXPECT_EQ(transfer().programs, "O0077 revision 1");
  EXPECT_NE(transfer().reason.find("the gateway stopped"), std::string::npos);
  ASSERT_EQ(send(program_, sha256(program_).hex(), "transfer-2").status, LineResult::Done);
  pass(1s);
  ASSERT_EQ(stop("stopped by cam").status, LineResult::Done);
  const auto aborted = transfer();
  EXPECT_EQ(aborted.state, dds::LineTransferState::Aborted);
  end();
  begin(kPlain);
  EXPECT_EQ(transfer().state, dds::LineTransferState::Aborted);
  EXPECT_EQ(transfer().id, "transfer-2");
  EXPECT_EQ(transfer().sent, aborted.sent);
  ASSERT_EQ(send(program_, sha256(program_).hex(), "transfer-3").status, LineResult::Done);
  ASSERT_TRUE(
      pass_until([&] { return transfer().state == dds::LineTransferState::Completed; }, 60s));
  end();
  begin(kPlain);
  EXPECT_FALSE(status().serial_line->transfer) << "it went through";
}

/// Its next DC1 asks for the rest of that text.
TEST_F(LineAnswersTest, ATextThatAControlWasReadingIsNotFollowedByARunAtItsNextRequest) {
  const std::string line = "line=9600n81\neob=lf\nflow=dc_codes";
  begin(line);
  ASSERT_EQ(send(program_).status, LineResult::Done);
  line_->receive("\x11");
  pass(1s);
  ASSERT_NE(wire_.sent, "");
  kill();
  begin(line);
  start("O0077\nG1 X1.\nM30\n");
  line_->receive("\x11");
  pass(2s);
  EXPECT_EQ(wire_.sent, "");
  line_->receive("\x13");
  pass(200ms);
  line_->receive("\x11");
  EXPECT_TRUE(pass_until([&] { return !wire_.sent.empty(); }, 5s)) << "that is its own request";
}

TEST_F(LineAnswersTest, AnAnswerThatNobodyFetchesCanBeStopped) {
  begin("line=9600n81\neob=lf\nflow=dc_codes");
  give(program_);
  pass(500ms);
  EXPECT_EQ(stop("stopped by cam").status, LineResult::Done);
  pass(500ms);
  EXPECT_EQ(send(program_).status, LineResult::Done) << "the line is free";
}

TEST_F(LineAnswersTest, ARunThatWentThroughIsTheEndOfATextThatDidNot) {
  begin(kPlain);
  ASSERT_EQ(send(program_).status, LineResult::Done);
  pass(1s);
  ASSERT_EQ(stop("stopped by cam").status, LineResult::Done);
  start("O0077\nG1 X1.\nM30\n");
  ASSERT_TRUE(pass_until([&] { return ended().has_value(); }, 60s));
  EXPECT_FALSE(status().serial_line->transfer);
  end();
  begin(kPlain);
  EXPECT_FALSE(status().serial_line->transfer);
}

TEST_F(LineAnswersTest, NothingLeavesThatWouldNotBeRemembered) {
  std::filesystem::create_directories(folder_.path() / "line-transfer.json.new" / "folder");
  begin(kPlain);
  const auto refused = send(program_);
  EXPECT_EQ(refused.status, LineResult::Refused);
  EXPECT_NE(refused.reason.find("line-transfer.json"), std::string::npos) << refused.reason;
  pass(1s);
  EXPECT_EQ(wire_.sent, "");
  EXPECT_FALSE(status().serial_line->transfer);
}

TEST_F(LineAnswersTest, RefusesToAskForAProgramWhereTheControlSendsUnasked) {
  begin(kPlain);
  const auto refused = ask(request(LineAction::Receive));
  EXPECT_NE(refused.reason.find("only over XMODEM"), std::string::npos) << refused.reason;
}

TEST_F(LineAnswersTest, JudgesATextByTheRules) {
  begin(kPlain,
        "[[rule]]\nname = \"send\"\nprogram = \"O9999\"\ntrigger = \"PRG\"\n"
        "action = \"send\"\nargument = \"O{}\"\n");
  auto judge = request(LineAction::Judge);
  const std::string text = "O9999\n(PRG=0077)\nM30\n";
  const auto bytes = std::as_bytes(std::span(text));
  judge.bytes = {bytes.begin(), bytes.end()};
  const auto verdict = line::decode_rule_verdict(text_of(ask(judge)));
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->action, "send");
  EXPECT_EQ(verdict->argument, "O0077");
}

TEST_F(LineAnswersTest, ShowsSinceWhenTheControlWaitsAndWhatItAskedFor) {
  begin("line=9600n81\neob=lf\nflow=dc_codes");
  EXPECT_FALSE(status().serial_line->asked);
  line_->receive("\x11");
  pass(500ms);
  ASSERT_TRUE(status().serial_line->asked);
  EXPECT_EQ(status().serial_line->asked->answer, "");
  EXPECT_LE(status().serial_line->asked->since, clock_.now());
}

}  // namespace
}  // namespace dripline::gateway
