#include "tests/unit/gateway/app/serial/serial_fixture.hpp"

/// A control in the middle of a program that was broken off asks for its rest with the character
/// that asks for a program: it gets no other one, however the gateway ended since.
namespace dripline::gateway {
namespace {

using namespace std::chrono_literals;

enum class End : std::uint8_t { Stopped, Killed, StoppedTwice, KilledThenStopped };
struct BrokenCase {
  std::string name;
  std::string flow;
  End end = End::Stopped;
};

class BrokenText : public SerialGatewayTest, public testing::WithParamInterface<BrokenCase> {
 protected:
  void begin_life() { begin("line=9600n81\neob=lf\nflow=" + GetParam().flow); }
  bool has_left(const std::string& text) const {
    return wire_.sent.find(text) != std::string::npos;
  }
  void start_short() { start("O0078\nG1 X78.\nM30\n"); }
  /// In the middle of O0077, which its control holds; then the process ends.
  void break_off() {
    begin_life();
    std::string text = "O0077\n";
    for (int i = 0; i < 400; ++i) text += fmt::format("G1 X{}.\n", i);
    start(text + "M30\n");
    line_->receive("\x11");
    pass(1s);
    ASSERT_TRUE(has_left("O0077"));
    line_->receive("\x13");
    pass(200ms);
    const bool is_killed =
        GetParam().end == End::Killed || GetParam().end == End::KilledThenStopped;
    is_killed ? kill() : stop_process();
    begin_life();
    if (GetParam().end != End::StoppedTwice && GetParam().end != End::KilledThenStopped) return;
    stop_process();
    begin_life();
  }
};

TEST_P(BrokenText, IsFollowedByNoOtherProgram) {
  break_off();
  start_short();
  line_->receive("\x11");
  pass(3s);
  EXPECT_FALSE(has_left("O0078")) << "the control asked for the rest of O0077";
  const std::string& fault = status().serial_line->fault;
  EXPECT_NE(fault.find("broken off"), std::string::npos) << fault;
  line_->receive("\x11");  // it was reset, and is started
  EXPECT_TRUE(pass_until([&] { return has_left("O0078"); }, 5s)) << status().message;
}

INSTANTIATE_TEST_SUITE_P(
    , BrokenText,
    testing::Values(BrokenCase{"dc_codes_stopped", "dc_codes", End::Stopped},
                    BrokenCase{"dc_codes_killed", "dc_codes", End::Killed},
                    BrokenCase{"dc_codes_stopped_twice", "dc_codes", End::StoppedTwice},
                    BrokenCase{"dc_codes_killed_then_stopped", "dc_codes", End::KilledThenStopped},
                    BrokenCase{"tnc_stopped", "heidenhain", End::Stopped},
                    BrokenCase{"tnc_killed", "heidenhain", End::Killed},
                    BrokenCase{"tnc_stopped_twice", "heidenhain", End::StoppedTwice},
                    BrokenCase{"tnc_killed_then_stopped", "heidenhain", End::KilledThenStopped}),
    [](const auto& i) { return std::string{i.param.name}; });

class TextToItsEnd : public SerialGatewayTest {
 protected:
  void begin_life() { begin("line=9600n81\neob=lf\nflow=dc_codes"); }
  bool is_begun_at_first_request() {
    start("O0078\nG1 X78.\nM30\n");
    line_->receive("\x11");
    return pass_until([&] { return wire_.sent.find("O0078") != std::string::npos; }, 5s);
  }
};

TEST_F(TextToItsEnd, IsFollowedByAnotherProgramAtTheFirstRequest) {
  begin_life();
  start("O0077\nG1 X1.\nM30\n");
  line_->receive("\x11");
  ASSERT_TRUE(pass_until([&] { return ended().has_value(); }, 30s));
  stop_process();
  begin_life();
  EXPECT_TRUE(is_begun_at_first_request());
}

/// Nothing of it has left: the control is in the middle of nothing.
TEST_F(TextToItsEnd, AProgramThatTheControlDidNotFetchIsNoneToReset) {
  begin_life();
  start("O0077\nG1 X1.\nM30\n");
  pass(1s);
  stop_process();
  begin_life();
  EXPECT_TRUE(is_begun_at_first_request());
}

/// What was broken off before it is.
TEST_F(TextToItsEnd, AProgramThatWaitsHidesNoneThatWasBrokenOff) {
  begin_life();
  std::string text = "O0077\n";
  for (int i = 0; i < 400; ++i) text += fmt::format("G1 X{}.\n", i);
  start(text + "M30\n");
  line_->receive("\x11");
  pass(1s);
  stop_process();
  begin_life();
  start("O0079\nM30\n");
  pass(1s);
  stop_process();
  begin_life();
  start("O0078\nG1 X78.\nM30\n");
  line_->receive("\x11");
  pass(3s);
  EXPECT_EQ(wire_.sent, "");
}

}  // namespace
}  // namespace dripline::gateway
