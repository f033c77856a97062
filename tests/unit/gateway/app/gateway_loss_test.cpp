#include <gtest/gtest.h>

#include "gateway/app/gateway.hpp"
#include "tests/unit/gateway/app/shop.hpp"

/// A gateway without text, without its server, ended in the middle, on a full disk.
namespace dripline::gateway {
namespace {

using dds::CommandAction;
using dds::Execution;
using dds::RecordKind;
using dds::RunOutcome;
using std::chrono::milliseconds;

TEST(Gateway, StarvedItWaitsForTextAndGoesOn) {
  Shop shop;
  shop.serves_text = false;
  shop.push("O1", "X1\nEND\n");
  ASSERT_TRUE(shop.start("O1").accepted);
  ASSERT_TRUE(shop.run_until([&] { return shop.status->execution == Execution::Waiting; }));
  EXPECT_NE(shop.status->message.find("waiting for program text"), std::string::npos);
  shop.serves_text = true;
  EXPECT_EQ(shop.ended().outcome, RunOutcome::Completed);
}

TEST(Gateway, WithoutAServerItGoesOnAndReportsLater) {
  Shop shop("1x");
  shop.push("O1", with_reports(20, 2));
  ASSERT_TRUE(shop.start("O1").accepted);
  ASSERT_TRUE(shop.run_until([&] { return shop.status->sent == shop.programs["O1"].size(); }));
  shop.connect(false);
  const std::size_t before = shop.records.size();
  ASSERT_TRUE(
      shop.run_until([&] { return shop.status->execution == Execution::ProgramCompleted; }));
  EXPECT_EQ(shop.records.size(), before);
  EXPECT_GT(shop.status->outbox, 0u);
  shop.connect(true);
  EXPECT_TRUE(shop.run_until([&] { return shop.count(RecordKind::RunEnded) == 1; }));
  EXPECT_EQ(shop.lines().size(), 20u);
}

TEST(Gateway, ARunCutOffEndsOnceAsInterruptedAtTheRightBlock) {
  for (int steps : {1, 2, 3, 5, 8, 13, 40}) {
    Shop shop("2x");
    shop.push("O1", with_reports(50, 2));
    ASSERT_TRUE(shop.start("O1").accepted);
    int turn = 0;
    shop.run_until([&] { return ++turn > steps; });
    shop.restart_gateway();
    const auto truth = shop.execution_probe();
    const auto end = shop.ended();
    EXPECT_EQ(end.outcome, RunOutcome::Interrupted) << steps;
    EXPECT_EQ(end.executed, truth.blocks_done) << steps;
    EXPECT_EQ(shop.lines().size(), truth.outputs_done) << steps;
    shop.restart_gateway();
    shop.run_until([&] { return false; }, milliseconds(1000));
    EXPECT_EQ(shop.count(RecordKind::RunEnded), 1u) << steps;
  }
}

TEST(Gateway, AnOrderlyStopEndsTheRunAsInterrupted) {
  Shop shop("10x");
  shop.push("O1", with_reports(50, 2));
  ASSERT_TRUE(shop.start("O1").accepted);
  ASSERT_TRUE(shop.run_until([&] { return shop.status->executed > 5; }));
  ASSERT_TRUE(shop.gateway->interrupt_run("stopped"));
  EXPECT_TRUE(shop.run_until([&] { return shop.gateway->is_delivered(); }));
  const auto end = dds::decode_run_end(shop.records.back().text).value();
  EXPECT_EQ(end.outcome, RunOutcome::Interrupted);
  EXPECT_EQ(end.reason, "stopped");
  EXPECT_EQ(end.executed, shop.execution_probe().blocks_done);
}

TEST(Gateway, AFullDiskHoldsTheMachineAndLosesNothing) {
  Shop shop("2x");
  shop.outbox_bytes = 160 * 1024;
  shop.restart_gateway();
  std::string text;
  for (int i = 0; i < 100; ++i)
    text +=
        "X" + std::to_string(i % 9) + "\nOUT " + std::to_string(i) + std::string(4000, 'x') + "\n";
  shop.push("O1", text + "END\n");
  ASSERT_TRUE(shop.start("O1").accepted);
  ASSERT_TRUE(shop.run_until([&] { return shop.status->sent == shop.programs["O1"].size(); },
                             milliseconds(1)));
  shop.connect(false);
  ASSERT_TRUE(shop.run_until(
      [&] { return shop.status->message.find("reports cannot be kept") != std::string::npos; }));
  const std::uint64_t held_at = shop.status->executed;
  EXPECT_LT(held_at, 201u);
  shop.connect(true);
  EXPECT_EQ(shop.ended().outcome, RunOutcome::Completed);
  const auto lines = shop.lines();
  ASSERT_EQ(lines.size(), 100u);
  for (std::size_t i = 0; i < lines.size(); ++i)
    EXPECT_EQ(lines[i].substr(0, lines[i].find('x')), std::to_string(i));
}

}  // namespace
}  // namespace dripline::gateway
