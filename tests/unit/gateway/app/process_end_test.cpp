#include <gtest/gtest.h>

#include "tests/unit/gateway/app/gateway_fixture.hpp"

/// The end of the process: SIGTERM. With a board: integration/grbl_end_test.cpp.
namespace dripline::gateway {
namespace {

using dds::CommandAction;
using dds::RecordKind;
using dds::RunOutcome;

constexpr const char* kRefused = "the gateway is stopping";
constexpr const char* kStopsAgain =
    "the gateway is stopping: what it moved was stopped already, and gets nothing more";

void ask_to_stop(GatewayFixture& fixture) {
  fixture.gateway->receive(StopRequested{15}, fixture.clock.steady);
}

/// A run in the middle of its first move.
void begin_moving(GatewayFixture& fixture) {
  fixture.push("O1", "X400\nX0\nOUT LATE\nEND\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(
      fixture.run_until([&] { return fixture.status && fixture.status->feed_mm_per_min > 100; }));
}

TEST(ProcessEnd, BringsTheMachineToRestBeforeTheRunIsOnRecordAsEnded) {
  GatewayFixture fixture("1x");
  begin_moving(fixture);
  ask_to_stop(fixture);
  EXPECT_FALSE(fixture.gateway->is_at_rest()) << "it brakes along its path";
  EXPECT_EQ(fixture.count(RecordKind::RunEnded), 0U);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.gateway->is_at_rest(); }));
  ASSERT_TRUE(fixture.gateway->interrupt_run("the gateway was stopped"));
  const double at = fixture.status->position[0];
  EXPECT_LT(at, 400);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.count(RecordKind::RunEnded) == 1; }));
  const auto end = dds::decode_run_end(fixture.records.back().text).value();
  EXPECT_EQ(end.outcome, RunOutcome::Interrupted);
  EXPECT_EQ(end.reason, "the gateway was stopped");
  EXPECT_EQ(end.executed, fixture.execution_probe().blocks_done);
  fixture.run_until([] { return false; });
  EXPECT_EQ(fixture.status->position[0], at);
  EXPECT_TRUE(fixture.lines().empty());
}

TEST(ProcessEnd, TakesStopsAndNothingElse) {
  GatewayFixture fixture("1x");
  begin_moving(fixture);
  ask_to_stop(fixture);
  EXPECT_EQ(fixture.panel("hold"), "ok");
  EXPECT_EQ(fixture.panel("cycle-start"), std::string("refused ") + kRefused);
  EXPECT_EQ(fixture.send(fixture.command(CommandAction::Resume)).reason, kRefused);
  EXPECT_TRUE(fixture.send(fixture.command(CommandAction::Hold)).accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.gateway->is_at_rest(); }));
  ASSERT_TRUE(fixture.gateway->interrupt_run("the gateway was stopped"));
  const double at = fixture.status->position[0];
  for (const char* verb : {"hold", "abort"})
    EXPECT_EQ(fixture.panel(verb), std::string("ok ") + kStopsAgain);
  EXPECT_TRUE(fixture.send(fixture.command(CommandAction::Abort)).accepted);
  for (const char* verb : {"home", "unlock", "cycle-start", "rewind"})
    EXPECT_EQ(fixture.panel(verb), std::string("refused ") + kRefused);
  EXPECT_EQ(fixture.start("O1").reason, kRefused);
  EXPECT_EQ(fixture.panel("emergency-stop on"), "ok");
  fixture.run_until([] { return false; });
  EXPECT_EQ(fixture.status->position[0], at);
  EXPECT_EQ(fixture.count(RecordKind::RunStarted), 1U);
}

TEST(ProcessEnd, IsWhatEndsTheRunWhereAnAbortComesAfterIt) {
  GatewayFixture fixture("1x");
  begin_moving(fixture);
  ask_to_stop(fixture);
  EXPECT_EQ(fixture.panel("abort"), "ok");
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Interrupted);
}

TEST(ProcessEnd, OfARunThatTheOperatorAbortedIsAnAbort) {
  GatewayFixture fixture("1x");
  begin_moving(fixture);
  EXPECT_EQ(fixture.panel("abort"), "ok");
  ask_to_stop(fixture);
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Aborted);
}

TEST(ProcessEnd, WithTheEmergencyStopPressedDoesNotWaitForItsRelease) {
  GatewayFixture fixture("1x");
  begin_moving(fixture);
  EXPECT_EQ(fixture.panel("emergency-stop on"), "ok");
  ask_to_stop(fixture);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.gateway->is_at_rest(); }));
  ASSERT_TRUE(fixture.gateway->interrupt_run("the gateway was stopped"));
  ASSERT_TRUE(fixture.run_until([&] { return fixture.count(RecordKind::RunEnded) == 1; }));
  EXPECT_EQ(dds::decode_run_end(fixture.records.back().text)->outcome, RunOutcome::Interrupted);
}

TEST(ProcessEnd, OnAFullDiskStopsTheMachineAllTheSame) {
  GatewayFixture fixture("1x");
  fixture.outbox_bytes = 160 * 1024;
  fixture.restart_gateway();
  std::string text;
  for (int i = 0; i < 60; ++i) text += "X1\nOUT " + std::string(4000, 'x') + "\nX0\n";
  fixture.push("O1", text + "END\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(
      fixture.run_until([&] { return fixture.status->sent == fixture.programs["O1"].size(); },
                        std::chrono::milliseconds(1)));
  fixture.connect(false);
  ASSERT_TRUE(fixture.run_until(
      [&] { return fixture.status->message.find("reports cannot be kept") != std::string::npos; }));
  ask_to_stop(fixture);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.gateway->is_at_rest(); }));
  EXPECT_FALSE(fixture.gateway->interrupt_run("the gateway was stopped"));
  const std::uint64_t done = fixture.execution_probe().blocks_done;
  fixture.outbox_bytes = 4ULL << 30;
  fixture.restart_gateway();
  fixture.connect(true);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.count(RecordKind::RunEnded) == 1; }));
  const auto end = dds::decode_run_end(fixture.records.back().text).value();
  EXPECT_EQ(end.outcome, RunOutcome::Interrupted);
  EXPECT_EQ(end.executed, done);
}

}  // namespace
}  // namespace dripline::gateway
