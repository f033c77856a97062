#include <gtest/gtest.h>

#include "tests/integration/line/line_gateway.hpp"
#include "tests/integration/system.hpp"
#include "tests/support/line/host_line.hpp"
#include "tests/support/line/pty.hpp"

/// A real gateway at the end of a line, as it is unless stated otherwise: people may be at the
/// machine.
namespace dripline::integration {
namespace {

const std::vector<std::string> kSettings{"baud=115200", "idle_end_ms=300", "rest_gap_ms=300"};
constexpr const char* kProgram = "O0077\nG20 G98\nP10=7\nPOPEN P1\nDPRNT [DONE]\nPCLOS\nM30\n";

wire::LineSettings host_settings() {
  wire::LineSettings settings = (*wire::find_template("centurion"))->settings;
  EXPECT_TRUE(wire::set_value(settings, "baud", "115200"));
  EXPECT_TRUE(wire::set_value(settings, "idle_end_ms", "300"));
  return settings;
}

class AttendedLine : public testing::Test {
 protected:
  test_support::Finished panel(const std::string& verb) const {
    return test_support::run_to_end(
        {program_path("dncgw"), "panel", "--state", gateway_.state(), verb},
        gateway_.state() / "panel.out");
  }
  test_support::PtyCable cable_;
  LineGateway gateway_{
      {.address = cable_.control(), .settings = kSettings, .is_unattended = false}};
  test_support::HostLine host_{cable_.host(), host_settings()};
};

TEST_F(AttendedLine, RunsWhatComesWhenCycleStartIsGivenAtItsPanel) {
  host_.send(kProgram);
  ASSERT_TRUE(gateway_.wait_logged("run begins with text from line"));
  const auto status = panel("status");
  EXPECT_EQ(status.status, 0);
  EXPECT_NE(status.output.find("remote_enable=not_given waits_for=cycle_start"), std::string::npos)
      << status.output;
  EXPECT_EQ(gateway_.runs_ended(), 0U);
  EXPECT_EQ(panel("cycle-start").output, "ok\n");
  ASSERT_TRUE(gateway_.wait_ended(1));
  EXPECT_EQ(gateway_.outputs(), std::vector<std::string>{"DONE"});
}

TEST_F(AttendedLine, RefusesAtItsPanelWithAReasonAndAStatus) {
  const auto refused = panel("cycle-start");
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.output.find("refused no run is active"), std::string::npos) << refused.output;
  EXPECT_EQ(panel("start").status, 2);
}

}  // namespace
}  // namespace dripline::integration
