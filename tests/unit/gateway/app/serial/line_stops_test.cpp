#include "gateway/app/panel/panel_controller.hpp"
#include "tests/unit/gateway/app/serial/line_answers_fixture.hpp"

/// Texts without a run that do not reach their end: stopped, or with their gateway.
namespace dripline::gateway {
namespace {

using namespace std::chrono_literals;
using LineStops = LineAnswersTest;

/// After an offered program that was broken off the next DC1 asks for the rest of it, however the
/// gateway ended.
TEST_F(LineStops, AnOfferThatAControlWasReadingIsFollowedByNoOtherOne) {
  const std::string line = "line=9600n81\neob=lf\nflow=dc_codes";
  for (const bool is_killed : {false, true}) {
    SCOPED_TRACE(is_killed);
    begin(line);
    line_->receive("\x11");
    pass(200ms);
    ASSERT_EQ(give(program_).status, LineResult::Done);
    pass(1s);
    ASSERT_NE(wire_.sent, "");
    line_->receive("\x13");
    pass(200ms);
    is_killed ? kill() : stop_process();
    begin(line);
    EXPECT_FALSE(status().serial_line->asked);
    stop_process();
    begin(line);
    line_->receive("\x11");
    pass(500ms);
    EXPECT_FALSE(status().serial_line->asked);
    EXPECT_FALSE(status().serial_line->call) << "the server decides of nothing";
    EXPECT_NE(status().serial_line->fault.find("reset the control and start again"),
              std::string::npos)
        << status().serial_line->fault;
    line_->receive("\x11");
    pass(500ms);
    EXPECT_TRUE(status().serial_line->call) << "that is its own request";
    end();
  }
}

TEST_F(LineStops, TheEmergencyStopEndsAnOfferAndKeepsTheNextOnesBack) {
  begin("line=9600n81\neob=lf\nflow=dc_codes");
  line_->receive("\x11");
  pass(200ms);
  ASSERT_EQ(give(program_).status, LineResult::Done);
  pass(1s);
  ASSERT_NE(wire_.sent, "");
  EXPECT_EQ(panel("emergency-stop on"), "ok");
  pass(100ms);
  const auto left = wire_.sent;
  pass(5s);
  EXPECT_EQ(wire_.sent, left);
  line_->receive("\x13\x11");
  pass(500ms);
  EXPECT_FALSE(status().serial_line->call) << "the request is void";
  EXPECT_FALSE(status().serial_line->asked && status().serial_line->asked->answer.empty());
  EXPECT_EQ(give(program_).reason, kEmergencyStopIsPressed);
  pass(2s);
  EXPECT_EQ(wire_.sent, left);
  EXPECT_EQ(panel("emergency-stop off"), "ok");
  pass(2s);
  EXPECT_EQ(wire_.sent, left) << "nothing continues by itself";
  line_->receive("\x13\x11");
  pass(200ms);
  ASSERT_EQ(give(program_).status, LineResult::Done);
  EXPECT_TRUE(pass_until([&] { return wire_.sent.size() > left.size() + 100; }, 5s));
}

/// Also what has not reached the line yet.
TEST_F(LineStops, TheEmergencyStopEndsAProgramThatIsJustBegun) {
  begin(kPlain);
  auto part = request(LineAction::Text);
  part.name = "transfer-1";
  const auto bytes = std::as_bytes(std::span(program_));
  part.bytes = {bytes.begin(), bytes.end()};
  ASSERT_EQ(ask(part).status, LineResult::Done);
  auto order = request(LineAction::Send, "send-1");
  order.name = "transfer-1";
  order.text = line::encode(line::TransferOrder{
      .content = sha256(program_).hex(), .name = "O0077", .programs = {"O0077"}});
  take(order);
  EXPECT_EQ(panel("emergency-stop on"), "ok");
  pass(2s);
  EXPECT_EQ(wire_.sent, "");
}

TEST_F(LineStops, AnAbortAtThePanelEndsAnOffer) {
  begin("line=9600n81\neob=lf\nflow=dc_codes");
  line_->receive("\x11");
  pass(200ms);
  ASSERT_EQ(give(program_).status, LineResult::Done);
  pass(1s);
  EXPECT_EQ(panel("abort"), "ok");
  pass(100ms);
  const auto left = wire_.sent;
  pass(5s);
  EXPECT_EQ(wire_.sent, left);
}

}  // namespace
}  // namespace dripline::gateway
