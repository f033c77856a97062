#include <gtest/gtest.h>

#include "gateway/app/gateway.hpp"
#include "tests/unit/gateway/app/gateway_fixture.hpp"

/// A gateway without text, without its server, ended in the middle, on a full disk.
namespace dripline::gateway {
namespace {

using dds::CommandAction;
using dds::Execution;
using dds::RecordKind;
using dds::RunOutcome;
using std::chrono::milliseconds;

TEST(Gateway, StarvedItWaitsForTextAndGoesOn) {
  GatewayFixture fixture;
  fixture.serves_text = false;
  fixture.push("O1", "X1\nEND\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status->execution == Execution::Waiting; }));
  EXPECT_NE(fixture.status->message.find("waiting for program text"), std::string::npos);
  fixture.serves_text = true;
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Completed);
}

TEST(Gateway, WithoutAServerItGoesOnAndReportsLater) {
  GatewayFixture fixture("1x");
  fixture.push("O1", with_reports(20, 2));
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(
      fixture.run_until([&] { return fixture.status->sent == fixture.programs["O1"].size(); }));
  fixture.connect(false);
  const std::size_t before = fixture.records.size();
  ASSERT_TRUE(
      fixture.run_until([&] { return fixture.status->execution == Execution::ProgramCompleted; }));
  EXPECT_EQ(fixture.records.size(), before);
  EXPECT_GT(fixture.status->outbox, 0u);
  fixture.connect(true);
  EXPECT_TRUE(fixture.run_until([&] { return fixture.count(RecordKind::RunEnded) == 1; }));
  EXPECT_EQ(fixture.lines().size(), 20u);
}

TEST(Gateway, ARunCutOffEndsOnceAsInterruptedAtTheRightBlock) {
  for (int steps : {1, 2, 3, 5, 8, 13, 40}) {
    GatewayFixture fixture("2x");
    fixture.push("O1", with_reports(50, 2));
    ASSERT_TRUE(fixture.start("O1").accepted);
    int turn = 0;
    fixture.run_until([&] { return ++turn > steps; });
    fixture.restart_gateway();
    const auto truth = fixture.execution_probe();
    const auto end = fixture.ended();
    EXPECT_EQ(end.outcome, RunOutcome::Interrupted) << steps;
    EXPECT_EQ(end.executed, truth.blocks_done) << steps;
    EXPECT_EQ(fixture.lines().size(), truth.outputs_done) << steps;
    fixture.restart_gateway();
    fixture.run_until([&] { return false; }, milliseconds(1000));
    EXPECT_EQ(fixture.count(RecordKind::RunEnded), 1u) << steps;
  }
}

TEST(Gateway, AnOrderlyStopEndsTheRunAsInterrupted) {
  GatewayFixture fixture("10x");
  fixture.push("O1", with_reports(50, 2));
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status->executed > 5; }));
  ASSERT_TRUE(fixture.gateway->interrupt_run("stopped"));
  EXPECT_TRUE(fixture.run_until([&] { return fixture.gateway->is_delivered(); }));
  const auto end = dds::decode_run_end(fixture.records.back().text).value();
  EXPECT_EQ(end.outcome, RunOutcome::Interrupted);
  EXPECT_EQ(end.reason, "stopped");
  EXPECT_EQ(end.executed, fixture.execution_probe().blocks_done);
}

TEST(Gateway, AFullDiskHoldsTheMachineAndLosesNothing) {
  GatewayFixture fixture("2x");
  fixture.outbox_bytes = 160 * 1024;
  fixture.restart_gateway();
  std::string text;
  for (int i = 0; i < 100; ++i)
    text +=
        "X" + std::to_string(i % 9) + "\nOUT " + std::to_string(i) + std::string(4000, 'x') + "\n";
  fixture.push("O1", text + "END\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(fixture.run_until(
      [&] { return fixture.status->sent == fixture.programs["O1"].size(); }, milliseconds(1)));
  fixture.connect(false);
  ASSERT_TRUE(fixture.run_until(
      [&] { return fixture.status->message.find("reports cannot be kept") != std::string::npos; }));
  const std::uint64_t held_at = fixture.status->executed;
  EXPECT_LT(held_at, 201u);
  fixture.connect(true);
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Completed);
  const auto lines = fixture.lines();
  ASSERT_EQ(lines.size(), 100u);
  for (std::size_t i = 0; i < lines.size(); ++i)
    EXPECT_EQ(lines[i].substr(0, lines[i].find('x')), std::to_string(i));
}

}  // namespace
}  // namespace dripline::gateway
