#include "tests/unit/gateway/app/serial/serial_fixture.hpp"

/// What a cut of the network means for the control, in the control's own time: the line carries 960
/// characters a second of a simulated clock, so ten minutes pass in seconds.
namespace dripline::gateway {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kRate = 960;  ///< characters a second at 9600 baud

std::string program_for(std::chrono::seconds time) {
  std::string text = "O0077\n";
  for (std::size_t i = 0; text.size() < kRate * static_cast<std::size_t>(time.count()); ++i)
    text += "N" + std::to_string(i) + " G1 X" + std::to_string(i % 999) + ".\n";
  return text + "M30\n";
}

/// What has left, as the program has it.
std::string as_program(const std::string& sent) {
  std::string text;
  for (const char c : sent)
    if (c != '\r' && c != '\x11' && c != '\x13') text += c;
  return text;
}

class NetworkCut : public SerialGatewayTest {
 protected:
  void begin_run(std::chrono::seconds time) {
    begin("line=9600n81\neob=lf\nflow=none");
    program_ = program_for(time);
    start(program_);
    pass(60s);  // the buffer is filled, and the line is busy
  }
  std::string program_;
};

TEST_F(NetworkCut, OfTenMinutesIsNotFeltByTheControlAtAnyMomentOfTheRun) {
  begin_run(30min);
  // Beforehand, at every moment while the server is there: what the buffer reaches for.
  double least = 1e9;
  each_step = [&] { least = std::min(least, status().buffered_seconds); };
  pass(3min);
  each_step = {};
  EXPECT_GE(least, 600) << "ten minutes are kept ahead of the line, not up to ten minutes";
  connect(false);
  wire_.longest = {};
  const std::size_t before = wire_.sent.size();
  pass(10min);
  EXPECT_GE(wire_.sent.size() - before, kRate * 600 - kRate / 10);
  EXPECT_LE(wire_.longest, 100ms) << "the line pauses";
  EXPECT_EQ(status().execution, dds::Execution::Active) << status().message;
  connect(true);
  ASSERT_TRUE(pass_until([&] { return ended().has_value(); }, 20min)) << status().message;
  EXPECT_LE(wire_.longest, 100ms) << "the line pauses when the server is back";
  EXPECT_EQ(ended()->outcome, dds::RunOutcome::Completed) << ended()->reason;
  EXPECT_EQ(ended()->content_sha256, sha256(program_).hex());
  EXPECT_EQ(as_program(wire_.sent), program_);
}

/// What the status states is kept to the second, and then the control gets nothing wrong: the
/// line waits, and continues without a gap when the server is back.
TEST_F(NetworkCut, LastsAsLongAsWasSaidBeforehandAndThenTheLineWaits) {
  begin_run(30min);
  connect(false);
  const double stated = status().buffered_seconds;
  const auto whole = static_cast<int>(stated);
  EXPECT_NE(status().message.find(
                fmt::format("{} min {} s of the line; no server", whole / 60, whole % 60)),
            std::string::npos)
      << status().message;
  const auto begun = clock_.steady_now();
  ASSERT_TRUE(pass_until([&] { return status().execution == dds::Execution::Waiting; }, 20min));
  const double lasted = std::chrono::duration<double>(clock_.steady_now() - begun).count();
  EXPECT_NEAR(lasted, stated, 1);
  EXPECT_EQ(status().waits_for, dds::WaitsFor::Text);
  const std::size_t sent = wire_.sent.size();
  pass(60s);
  EXPECT_EQ(wire_.sent.size(), sent);
  connect(true);
  ASSERT_TRUE(pass_until([&] { return ended().has_value(); }, 40min)) << status().message;
  EXPECT_EQ(as_program(wire_.sent), program_);
}

/// A control at the end of a line would execute what is sent to it.
TEST_F(SerialGatewayTest, RefusesATestRunAndSendsNothing) {
  begin("line=9600n81\neob=lf\nflow=none");
  for (const char* argument : {"test=yes", "N10 head=send test=yes"}) {
    order("O0077\nN10 G1 X9.\nM30\n", argument);
    ASSERT_TRUE(result_);
    EXPECT_FALSE(result_->accepted);
    EXPECT_NE(result_->reason.find("it has no test run"), std::string::npos) << result_->reason;
  }
  pass(5s);
  EXPECT_EQ(wire_.sent, "");
  EXPECT_TRUE(records_.empty());
  EXPECT_TRUE(status().run.empty());
}

}  // namespace
}  // namespace dripline::gateway
