#include <gtest/gtest.h>

#include "tests/unit/gateway/app/gateway_fixture.hpp"

/// What is asked at the machine's panel, and taken late.
namespace dripline::gateway {
namespace {

PanelCommand command_of_line(const char* line) {
  return parse_panel_command(line).value();
}

TEST(LatePanelRequest, OnlyAStopIsCarriedOut) {
  for (const char* stop :
       {"status", "hold", "abort", "emergency-stop", "emergency-stop on", "feed-override 0",
        "rapid-override 0", "remote-enable off", "switch emergency_stop on"})
    EXPECT_TRUE(is_stop(command_of_line(stop))) << stop;
  for (const char* other :
       {"cycle-start", "remote-enable on", "emergency-stop off", "switch emergency_stop off",
        "answer 1", "switch single_block on", "feed-override 10", "rapid-override 100",
        "spindle-override 50", "handwheel 1", "home", "unlock", "rewind", "discard-memory"})
    EXPECT_FALSE(is_stop(command_of_line(other))) << other;
}

class LatePanel : public testing::Test {
 protected:
  LatePanel() {
    fixture_.make_attended();
    fixture_.push("O1", "OUT A\nX4\nOUT B\nEND\n");
    EXPECT_TRUE(fixture_.start("O1").accepted);
    EXPECT_TRUE(fixture_.run_until(
        [&] { return fixture_.status->waits_for == dds::WaitsFor::CycleStart; }));
  }
  std::string give(const char* line, const std::string& why_late) {
    std::string answer;
    fixture_.gateway->receive(
        PanelRequest{.command = command_of_line(line),
                     .answer = [&](std::string text) { answer = std::move(text); },
                     .why_late = [&] { return why_late; }},
        fixture_.clock.steady);
    return answer;
  }
  GatewayFixture fixture_;
};

TEST_F(LatePanel, StartsNothing) {
  EXPECT_EQ(give("cycle-start", "its sender waits no longer"),
            "refused too late: its sender waits no longer; give it again");
  EXPECT_EQ(give("remote-enable on", "it is old"), "refused too late: it is old; give it again");
  fixture_.run_until([] { return false; });
  EXPECT_TRUE(fixture_.lines().empty()) << "nothing of the program happens";
  EXPECT_EQ(fixture_.status->waits_for, dds::WaitsFor::CycleStart);
  EXPECT_EQ(give("cycle-start", ""), "ok");
  EXPECT_EQ(fixture_.ended().outcome, dds::RunOutcome::Completed);
}

TEST_F(LatePanel, StopsAtAnyTime) {
  EXPECT_EQ(give("emergency-stop", "it is old"), "ok");
  EXPECT_EQ(give("emergency-stop off", "it is old"), "refused too late: it is old; give it again");
  EXPECT_EQ(give("emergency-stop off", ""), "ok");
  EXPECT_EQ(fixture_.ended().outcome, dds::RunOutcome::Aborted);
}

}  // namespace
}  // namespace dripline::gateway
