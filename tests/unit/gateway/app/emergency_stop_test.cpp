#include <gtest/gtest.h>

#include "gateway/interpreter/core/dialects.hpp"
#include "tests/unit/gateway/app/gateway_fixture.hpp"

/// The emergency stop at the panel of every machine, whatever its control. Row: HD-195.
namespace dripline::gateway {
namespace {

using dds::CommandAction;
using dds::Execution;
using dds::RecordKind;
using dds::RunOutcome;

constexpr const char* kPressed =
    "the emergency stop is pressed: release it first (switch emergency_stop off)";

dds::CommandResult set_emergency_stop(GatewayFixture& fixture, bool is_pressed) {
  dds::Command command = fixture.command(CommandAction::Switch);
  command.argument = "emergency_stop";
  command.value = is_pressed ? 1 : 0;
  return fixture.send(command);
}

/// A run in motion, and the switch pressed.
void press_in_motion(GatewayFixture& fixture) {
  fixture.push("O1", "X400\nX0\nEND\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(
      fixture.run_until([&] { return fixture.status && fixture.status->feed_mm_per_min > 0; }));
  ASSERT_TRUE(set_emergency_stop(fixture, true).accepted);
}

TEST(EmergencyStop, StopsARunForGoodOnceItIsReleased) {
  GatewayFixture fixture("1x");
  press_in_motion(fixture);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status->feed_mm_per_min == 0; }));
  EXPECT_EQ(fixture.status->execution, Execution::Stopped);
  EXPECT_EQ(fixture.status->message, "EMERGENCY STOP");
  EXPECT_EQ(fixture.status->run, "run-1") << "the run waits for the switch";
  EXPECT_EQ(fixture.count(RecordKind::RunEnded), 0U);
  const double stands_at = fixture.status->position[0];
  EXPECT_EQ(fixture.send(fixture.command(CommandAction::Resume)).reason, kPressed);

  ASSERT_TRUE(set_emergency_stop(fixture, false).accepted);
  const auto end = fixture.ended();
  EXPECT_EQ(end.outcome, RunOutcome::Aborted);
  EXPECT_EQ(end.reason, "EMERGENCY STOP");
  EXPECT_EQ(end.executed, 0U);
  EXPECT_FALSE(fixture.send(fixture.command(CommandAction::Resume)).accepted);
  EXPECT_EQ(fixture.status->position[0], stands_at);
}

TEST(EmergencyStop, IsOnRecordBeforeTheRunEnds) {
  GatewayFixture fixture("1x");
  press_in_motion(fixture);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.count(RecordKind::Stop) == 1; }));
  const dds::Record& record = fixture.records.back();
  EXPECT_EQ(record.text, "emergency stop");
  EXPECT_EQ(record.run, "run-1");
  EXPECT_EQ(record.line, 1U);
  ASSERT_TRUE(set_emergency_stop(fixture, true).accepted);
  ASSERT_TRUE(set_emergency_stop(fixture, false).accepted);
  fixture.ended();
  EXPECT_EQ(fixture.count(RecordKind::Stop), 1U);
}

TEST(EmergencyStop, LetsNoRunBeginWhileItIsPressed) {
  GatewayFixture fixture("1x");
  fixture.push("O1", "X4\nEND\n");
  ASSERT_TRUE(set_emergency_stop(fixture, true).accepted);
  const auto refused = fixture.start("O1");
  EXPECT_FALSE(refused.accepted);
  EXPECT_EQ(refused.reason, kPressed);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status->message == "EMERGENCY STOP"; }));
  EXPECT_EQ(fixture.status->execution, Execution::Stopped);
  EXPECT_TRUE(fixture.records.empty());
  ASSERT_TRUE(set_emergency_stop(fixture, false).accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status->message.empty(); }));
  EXPECT_EQ(fixture.status->execution, Execution::Ready);
  ASSERT_TRUE(fixture.start("O1").accepted);
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Completed);
}

TEST(EmergencyStop, EndsARunThatWaitsForItsOperator) {
  GatewayFixture fixture;
  fixture.push("O1", "ASK DEPTH\nEND\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status->execution == Execution::Waiting; }));
  ASSERT_TRUE(set_emergency_stop(fixture, true).accepted);
  ASSERT_TRUE(set_emergency_stop(fixture, false).accepted);
  EXPECT_EQ(fixture.ended().reason, "EMERGENCY STOP");
}

TEST(EmergencyStop, OfAnAbortedRunLeavesTheNextOnesReasonAlone) {
  GatewayFixture fixture("1x");
  press_in_motion(fixture);
  ASSERT_TRUE(set_emergency_stop(fixture, false).accepted);
  fixture.ended();
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(fixture.send(fixture.command(CommandAction::Abort)).accepted);
  EXPECT_EQ(fixture.ended().reason, "aborted by command");
}

TEST(EmergencyStop, TurnsSpindleAndCoolantOfATncOff) {
  GatewayFixture fixture(interpreter::kTnc155Dialect, {}, "1x");
  fixture.push("7",
               "0 BEGIN PGM 7 MM\n1 TOOL CALL 0 Z S 500,000\n2 L Z+50,000 R0 F9999 M13\n"
               "3 L X+400,000 R0 F500 M\n4 END PGM 7 MM\n");
  ASSERT_TRUE(fixture.start("7").accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status && fixture.status->line == 4; }));
  EXPECT_GT(fixture.status->spindle_rpm, 0);
  EXPECT_TRUE(fixture.status->modes->flood);
  ASSERT_TRUE(set_emergency_stop(fixture, true).accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status->feed_mm_per_min == 0; }));
  EXPECT_EQ(fixture.status->spindle_rpm, 0);
  EXPECT_FALSE(fixture.status->modes->flood);
}

}  // namespace
}  // namespace dripline::gateway
