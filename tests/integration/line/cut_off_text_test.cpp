#include <gtest/gtest.h>
#include <bit>

#include "tests/integration/line/line_gateway.hpp"
#include "tests/integration/system.hpp"
#include "tests/support/line/host_line.hpp"
#include "tests/support/line/pty.hpp"

/// After an alarm in the middle of a text, at a gateway that needs no consent: the rest of it
/// begins no run, however long the pause before it.
namespace dripline::integration {
namespace {

using namespace std::chrono_literals;
using test_support::eventually;

constexpr const char* kBegins = "run begins with text from line";

std::string cycle_start(const LineGateway& gateway) {
  return test_support::run_to_end(
             {program_path("dncgw"), "panel", "--state", gateway.state(), "cycle-start"},
             gateway.state() / "panel.out")
      .output;
}

std::size_t count_of(const std::string& text, std::string_view what) {
  std::size_t times = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++times;
  return times;
}

/// Bit 8 makes the number of holes even.
std::string iso(std::string text) {
  for (char& c : text) {
    if (std::popcount(static_cast<unsigned char>(c)) % 2 != 0) c = static_cast<char>(c | '\x80');
  }
  return text;
}

std::string spoiled(std::string row) {
  row[0] = static_cast<char>(row[0] ^ '\x80');
  return row;
}

/// The reader is in the test's hands: it gives rows after DC1, none after DC3.
TEST(CutOffText, OfATapeIsReadOnByTheOperatorAlone) {
  const test_support::Pty reader;
  LineGateway gateway({.address = reader.path(),
                       .settings = {},
                       .arguments = {"--line-template", "tektronix1704-iso"},
                       .control = "tektronix-1704"});
  std::string heard;
  const auto is_run = [&] {
    heard += reader.read_available();
    const auto last = heard.find_last_of("\x11\x13");
    return last != std::string::npos && heard[last] == '\x11';
  };
  ASSERT_TRUE(eventually(is_run));
  reader.write(iso("%\nN001G90\nN002G01X10000F0400\nN003Y10000\n") + iso("N00") +
               spoiled(iso("4")));
  ASSERT_TRUE(gateway.wait_ended(1)) << gateway.log();
  ASSERT_TRUE(gateway.wait_logged("the tape is where its run was cut off")) << gateway.log();
  EXPECT_FALSE(is_run());
  const std::string rest = iso("X20000\nN005G01Y20000F0400\nN006X30000\nN007M02\n");
  reader.write(rest);
  EXPECT_EQ(cycle_start(gateway), "ok the next text of the line begins a run\n");
  ASSERT_TRUE(eventually(is_run));
  reader.write(rest);
  ASSERT_TRUE(gateway.wait_ended(2)) << gateway.log();
  EXPECT_EQ(count_of(gateway.log(), kBegins), 2U);
  const auto endings = gateway.endings();
  ASSERT_EQ(endings.size(), 2U);
  EXPECT_NE(endings[0].reason.find("READ ERROR"), std::string::npos) << endings[0].reason;
  EXPECT_EQ(endings[0].executed, 3U);
}

class CutOffProgram : public testing::Test {
 protected:
  static wire::LineSettings host_settings() {
    wire::LineSettings settings = (*wire::find_template("centurion"))->settings;
    EXPECT_TRUE(wire::set_value(settings, "baud", "115200"));
    EXPECT_TRUE(wire::set_value(settings, "idle_end_ms", "300"));
    return settings;
  }
  /// An alarm, with text after it.
  void cut_off() {
    host_.send("O0077\nG20 G98\nG1 X1. F50.\nX[1\nX2.\n");
    ASSERT_TRUE(gateway_.wait_ended(1)) << gateway_.log();
    ASSERT_TRUE(eventually([&] { return host_.is_idle(); }));
  }
  /// What comes after a pause.
  void leave_out_rest() {
    for (std::size_t part = 1; count_of(gateway_.log(), "begins no run") == 0 && part < 40;
         ++part) {
      host_.send("G1 X3. F50.\nX4.\n");
      ASSERT_TRUE(eventually([&] { return host_.is_idle(); }));
      std::this_thread::sleep_for(1s);
    }
    EXPECT_EQ(count_of(gateway_.log(), kBegins), 1U) << gateway_.log();
    EXPECT_TRUE(gateway_.wait_logged("begins no run")) << gateway_.log();
  }
  test_support::PtyCable cable_;
  LineGateway gateway_{{.address = cable_.control(),
                        .settings = {"baud=115200", "idle_end_ms=300", "rest_gap_ms=300"}}};
  test_support::HostLine host_{cable_.host(), host_settings()};
};

TEST_F(CutOffProgram, IsContinuedByNoRun) {
  cut_off();
  leave_out_rest();
  std::this_thread::sleep_for(2s);
  host_.send("O0078\nG20 G98\nPOPEN P1\nDPRNT [DONE]\nPCLOS\nM30\n");
  ASSERT_TRUE(gateway_.wait_ended(2)) << gateway_.log();
  EXPECT_EQ(gateway_.outputs(), std::vector<std::string>{"DONE"});
}

/// The rest of a program whose run ended with its gateway: after any number of lives.
TEST_F(CutOffProgram, IsContinuedByNoRunOfALaterLife) {
  host_.send("O0077\nG20 G98\nG1 X1. F.1\n");
  ASSERT_TRUE(gateway_.wait_logged(kBegins)) << gateway_.log();
  ASSERT_TRUE(eventually([&] { return host_.is_idle(); }));
  gateway_.restart(false);
  leave_out_rest();
  gateway_.restart(true);
  gateway_.restart(false);
  host_.send("G1 X3. F50.\nX4.\n");
  ASSERT_TRUE(gateway_.wait_logged("begins no run", 2)) << gateway_.log();
  EXPECT_EQ(cycle_start(gateway_), "ok the next text of the line begins a run\n");
  gateway_.restart(false);
  ASSERT_TRUE(eventually([&] { return host_.is_idle(); }));
  std::this_thread::sleep_for(2s);
  host_.send("G20 G98\nPOPEN P1\nDPRNT [DONE]\nPCLOS\nM30\n");
  ASSERT_TRUE(gateway_.wait_ended(2)) << gateway_.log();
  EXPECT_EQ(gateway_.outputs(), std::vector<std::string>{"DONE"});
}

TEST_F(CutOffProgram, IsContinuedAfterCycleStart) {
  cut_off();
  leave_out_rest();
  EXPECT_EQ(cycle_start(gateway_), "ok the next text of the line begins a run\n");
  EXPECT_NE(cycle_start(gateway_).find("no run is active"), std::string::npos);
  std::this_thread::sleep_for(2s);
  host_.send("G20 G98\nPOPEN P1\nDPRNT [DONE]\nPCLOS\nM30\n");
  ASSERT_TRUE(gateway_.wait_ended(2)) << gateway_.log();
  EXPECT_EQ(gateway_.outputs(), std::vector<std::string>{"DONE"});
}

}  // namespace
}  // namespace dripline::integration
