#include "gateway/app/panel/consent.hpp"

#include <gtest/gtest.h>
#include <cmath>

#include "tests/unit/gateway/app/gateway_fixture.hpp"

/// What the network may do at a machine at which people may be.
namespace dripline::gateway {
namespace {

using dds::CommandAction;
using dds::Execution;
using dds::RemoteEnable;
using dds::RunOutcome;
using dds::WaitsFor;
using namespace std::chrono_literals;

struct ConsentCase {
  const char* name;
  dds::Command command;
  bool needs;
};
dds::Command order_of(CommandAction action, double value = 0, const char* argument = "") {
  dds::Command command;
  command.action = action;
  command.value = value;
  command.argument = argument;
  return command;
}

class NeedsConsent : public testing::TestWithParam<ConsentCase> {};

/// All switches on, every override at 50 %.
TEST_P(NeedsConsent, IsJudged) {
  machine::OperatorPanel panel;
  panel.single_block = panel.optional_stop = panel.block_skip = panel.machine_lock = true;
  panel.test_run = true;
  panel.handwheel = panel.emergency_stop = true;
  panel.feed_override = panel.rapid_override = panel.spindle_override = 0.5;
  EXPECT_EQ(needs_consent(GetParam().command, panel), GetParam().needs);
}

INSTANTIATE_TEST_SUITE_P(
    , NeedsConsent,
    testing::Values(
        ConsentCase{"hold", order_of(CommandAction::Hold), false},
        ConsentCase{"abort", order_of(CommandAction::Abort), false},
        ConsentCase{"start_waits", order_of(CommandAction::Start), false},
        ConsentCase{"resume", order_of(CommandAction::Resume), true},
        ConsentCase{"answer", order_of(CommandAction::Answer), true},
        ConsentCase{"handwheel", order_of(CommandAction::Handwheel, 1), true},
        ConsentCase{"press_stop", order_of(CommandAction::Switch, 1, "emergency_stop"), false},
        ConsentCase{"release_stop", order_of(CommandAction::Switch, 0, "emergency_stop"), true},
        ConsentCase{"single_block_on", order_of(CommandAction::Switch, 1, "single_block"), false},
        ConsentCase{"single_block_off", order_of(CommandAction::Switch, 0, "single_block"), true},
        ConsentCase{"optional_stop_off", order_of(CommandAction::Switch, 0, "optional_stop"), true},
        ConsentCase{"handwheel_off", order_of(CommandAction::Switch, 0, "handwheel"), true},
        ConsentCase{"block_skip_off", order_of(CommandAction::Switch, 0, "block_skip"), true},
        ConsentCase{"block_skip_2_on", order_of(CommandAction::Switch, 1, "block_skip_2"), true},
        ConsentCase{"dry_run_on", order_of(CommandAction::Switch, 1, "dry_run"), true},
        ConsentCase{"dry_run_off", order_of(CommandAction::Switch, 0, "dry_run"), true},
        ConsentCase{"machine_lock_on", order_of(CommandAction::Switch, 1, "machine_lock"), false},
        ConsentCase{"machine_lock_off", order_of(CommandAction::Switch, 0, "machine_lock"), true},
        ConsentCase{"test_run_on", order_of(CommandAction::Switch, 1, "test_run"), false},
        ConsentCase{"test_run_off", order_of(CommandAction::Switch, 0, "test_run"), true},
        ConsentCase{"slower", order_of(CommandAction::FeedOverride, 0.4), false},
        ConsentCase{"same", order_of(CommandAction::FeedOverride, 0.5), false},
        ConsentCase{"faster", order_of(CommandAction::FeedOverride, 0.6), true},
        ConsentCase{"faster_rapid", order_of(CommandAction::RapidOverride, 0.6), true},
        ConsentCase{"faster_spindle", order_of(CommandAction::SpindleOverride, 0.6), true},
        ConsentCase{"no_number", order_of(CommandAction::FeedOverride, std::nan("")), true}),
    [](const auto& i) { return std::string{i.param.name}; });

class AttendedMachine : public testing::Test {
 protected:
  AttendedMachine() {
    fixture_.make_attended();
    fixture_.push("O1", "OUT FIRST\nX40\nSTOP\nX0\nEND\n");
  }
  bool reaches(WaitsFor waits_for) {
    return fixture_.run_until(
        [&] { return fixture_.status && fixture_.status->waits_for == waits_for; });
  }
  dds::CommandResult give(CommandAction action, double value = 0, const char* argument = "") {
    dds::Command command = fixture_.command(action);
    command.value = value;
    command.argument = argument;
    return fixture_.send(command);
  }
  GatewayFixture fixture_{"1x"};
};

TEST_F(AttendedMachine, WaitsForCycleStartAtTheMachine) {
  ASSERT_TRUE(fixture_.start("O1").accepted);
  ASSERT_TRUE(reaches(WaitsFor::CycleStart));
  EXPECT_EQ(fixture_.status->execution, Execution::Waiting);
  EXPECT_EQ(fixture_.status->message, kAwaitsCycleStart);
  EXPECT_EQ(fixture_.status->remote_enable, RemoteEnable::NotGiven);
  EXPECT_EQ(fixture_.status->run, "run-1");
  EXPECT_EQ(give(CommandAction::Resume).reason, kNoConsent);
  fixture_.run_until([] { return false; });
  EXPECT_TRUE(fixture_.lines().empty()) << "nothing of the program happens";
  EXPECT_EQ(fixture_.status->position[0], 0);

  EXPECT_EQ(fixture_.panel("cycle-start"), "ok");
  ASSERT_TRUE(fixture_.run_until([&] { return fixture_.status->position[0] != 0; }));
  EXPECT_EQ(fixture_.lines(), std::vector<std::string>{"FIRST"});
  EXPECT_EQ(fixture_.records[1].text, "at the machine's panel: cycle start");
}

TEST_F(AttendedMachine, RunsToItsEndByItsPanelAlone) {
  ASSERT_TRUE(fixture_.start("O1").accepted);
  ASSERT_TRUE(reaches(WaitsFor::CycleStart));
  EXPECT_EQ(fixture_.panel("cycle-start"), "ok");
  ASSERT_TRUE(
      fixture_.run_until([&] { return fixture_.status->execution == Execution::ProgramStopped; }));
  EXPECT_EQ(fixture_.status->waits_for, WaitsFor::CycleStart);
  EXPECT_EQ(give(CommandAction::Resume).reason, kNoConsent);
  EXPECT_EQ(fixture_.panel("cycle-start"), "ok");
  EXPECT_EQ(fixture_.ended().outcome, RunOutcome::Completed);
  EXPECT_EQ(fixture_.panel("cycle-start"), "refused no run is active");
}

TEST_F(AttendedMachine, IsStartedFromAfarWithTheRemoteEnable) {
  EXPECT_EQ(fixture_.panel("remote-enable on"), "ok");
  ASSERT_TRUE(fixture_.start("O1").accepted);
  ASSERT_TRUE(
      fixture_.run_until([&] { return fixture_.status->execution == Execution::ProgramStopped; }));
  EXPECT_EQ(fixture_.status->remote_enable, RemoteEnable::Given);
  EXPECT_TRUE(give(CommandAction::Resume).accepted);
  EXPECT_EQ(fixture_.ended().outcome, RunOutcome::Completed);

  EXPECT_EQ(fixture_.panel("remote-enable off"), "ok");
  ASSERT_TRUE(fixture_.start("O1").accepted);
  ASSERT_TRUE(reaches(WaitsFor::CycleStart));
}

TEST_F(AttendedMachine, IsNotMovedByTheEnableItself) {
  ASSERT_TRUE(fixture_.start("O1").accepted);
  ASSERT_TRUE(reaches(WaitsFor::CycleStart));
  EXPECT_EQ(fixture_.panel("remote-enable on"), "ok");
  fixture_.run_until([] { return false; });
  EXPECT_EQ(fixture_.status->waits_for, WaitsFor::CycleStart);
  EXPECT_EQ(fixture_.status->position[0], 0);
  EXPECT_TRUE(give(CommandAction::Resume).accepted);
  ASSERT_TRUE(fixture_.run_until([&] { return fixture_.status->position[0] != 0; }));
}

TEST_F(AttendedMachine, CanAlwaysBeStopped) {
  ASSERT_TRUE(fixture_.start("O1").accepted);
  ASSERT_TRUE(reaches(WaitsFor::CycleStart));
  EXPECT_TRUE(give(CommandAction::Hold).accepted);
  EXPECT_TRUE(give(CommandAction::FeedOverride, 0.5).accepted);
  EXPECT_EQ(give(CommandAction::FeedOverride, 0.6).reason, kNoConsent);
  EXPECT_TRUE(give(CommandAction::Abort).accepted);
  EXPECT_EQ(fixture_.ended().outcome, RunOutcome::Aborted);
  EXPECT_EQ(fixture_.count(dds::RecordKind::Output), 0U);
}

TEST_F(AttendedMachine, GivesUpARunThatNobodyBegins) {
  ASSERT_TRUE(fixture_.start("O1").accepted);
  ASSERT_TRUE(reaches(WaitsFor::CycleStart));
  fixture_.clock.steady += 1800s;
  const auto end = fixture_.ended();
  EXPECT_EQ(end.outcome, RunOutcome::Aborted);
  EXPECT_EQ(end.reason, "no cycle start at the machine within 1800 s");
  EXPECT_EQ(end.executed, 0U);
}

TEST_F(AttendedMachine, LosesTheEnableWithTheEmergencyStop) {
  EXPECT_EQ(fixture_.panel("remote-enable on"), "ok");
  ASSERT_TRUE(give(CommandAction::Switch, 1, "emergency_stop").accepted);
  EXPECT_EQ(give(CommandAction::Switch, 0, "emergency_stop").reason, kNoConsent);
  EXPECT_EQ(fixture_.panel("remote-enable on"),
            "refused the emergency stop is pressed: release it first");
  EXPECT_EQ(fixture_.panel("emergency-stop off"), "ok");
  ASSERT_TRUE(fixture_.start("O1").accepted);
  ASSERT_TRUE(reaches(WaitsFor::CycleStart));
}

TEST_F(AttendedMachine, ForgetsTheEnableWithItsProcess) {
  EXPECT_EQ(fixture_.panel("remote-enable on"), "ok");
  fixture_.restart_gateway();
  ASSERT_TRUE(fixture_.start("O1").accepted);
  ASSERT_TRUE(reaches(WaitsFor::CycleStart));
}

TEST_F(AttendedMachine, EndsARunThatWaitsWhenItsEmergencyStopWasPressed) {
  ASSERT_TRUE(fixture_.start("O1").accepted);
  ASSERT_TRUE(reaches(WaitsFor::CycleStart));
  EXPECT_EQ(fixture_.panel("emergency-stop"), "ok");
  EXPECT_EQ(fixture_.panel("cycle-start"),
            "refused the emergency stop is pressed: release it first");
  EXPECT_EQ(fixture_.panel("emergency-stop off"), "ok");
  EXPECT_EQ(fixture_.ended().reason, "EMERGENCY STOP");
}

TEST_F(AttendedMachine, AnswersItsProgramAtThePanel) {
  fixture_.push("O2", "ASK DEPTH\nEND\n");
  ASSERT_TRUE(fixture_.start("O2").accepted);
  ASSERT_TRUE(reaches(WaitsFor::CycleStart));
  EXPECT_EQ(fixture_.panel("cycle-start"), "ok");
  ASSERT_TRUE(reaches(WaitsFor::Answer));
  EXPECT_EQ(give(CommandAction::Answer, 0, "5").reason, kNoConsent);
  EXPECT_EQ(fixture_.panel("answer 7"), "ok");
  EXPECT_EQ(fixture_.ended().outcome, RunOutcome::Completed);
  EXPECT_EQ(fixture_.lines(), std::vector<std::string>{"7"});
}

TEST(UnattendedMachine, IsStartedFromAfarAndSaysSo) {
  GatewayFixture fixture;
  fixture.push("O1", "X4\nEND\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Completed);
  EXPECT_EQ(fixture.status->remote_enable, RemoteEnable::Unattended);
  EXPECT_TRUE(fixture.panel("remote-enable on").starts_with("refused this machine is unattended"));
}

/// Pressed at the machine.
TEST(UnattendedMachine, KeepsAnEmergencyStopOfItsPanelUntilItIsReleasedThere) {
  GatewayFixture fixture;
  EXPECT_EQ(fixture.panel("emergency-stop"), "ok");
  dds::Command release = fixture.command(CommandAction::Switch);
  release.argument = "emergency_stop";
  EXPECT_EQ(fixture.send(release).reason,
            "the emergency stop was pressed at the machine's panel: release it there");
  EXPECT_EQ(fixture.panel("emergency-stop off"), "ok");
  fixture.push("O1", "X4\nEND\n");
  EXPECT_TRUE(fixture.start("O1").accepted);
}

TEST(UnattendedMachine, TellsItsPanelWhatItDoes) {
  GatewayFixture fixture("1x");
  EXPECT_EQ(fixture.panel("status"),
            "ok READY remote_enable=unattended waits_for=nothing emergency_stop=released");
}

}  // namespace
}  // namespace dripline::gateway
