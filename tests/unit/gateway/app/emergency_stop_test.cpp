#include <gtest/gtest.h>

#include "gateway/interpreter/dialects/tnc155/dialect.hpp"
#include "tests/unit/gateway/app/shop.hpp"

/// The emergency stop at the panel of every machine, whatever its control. Row: HD-195.
namespace dripline::gateway {
namespace {

using dds::CommandAction;
using dds::Execution;
using dds::RecordKind;
using dds::RunOutcome;

constexpr const char* kPressed =
    "the emergency stop is pressed: release it first (switch emergency_stop off)";

dds::CommandResult set_emergency_stop(Shop& shop, bool is_pressed) {
  dds::Command command = shop.command(CommandAction::Switch);
  command.argument = "emergency_stop";
  command.value = is_pressed ? 1 : 0;
  return shop.send(command);
}

/// A run in motion, and the switch pressed.
void press_in_motion(Shop& shop) {
  shop.push("O1", "X400\nX0\nEND\n");
  ASSERT_TRUE(shop.start("O1").accepted);
  ASSERT_TRUE(shop.run_until([&] { return shop.status && shop.status->feed_mm_per_min > 0; }));
  ASSERT_TRUE(set_emergency_stop(shop, true).accepted);
}

TEST(EmergencyStop, StopsARunForGoodOnceItIsReleased) {
  Shop shop("1x");
  press_in_motion(shop);
  ASSERT_TRUE(shop.run_until([&] { return shop.status->feed_mm_per_min == 0; }));
  EXPECT_EQ(shop.status->execution, Execution::Stopped);
  EXPECT_EQ(shop.status->message, "EMERGENCY STOP");
  EXPECT_EQ(shop.status->run, "run-1") << "the run waits for the switch";
  EXPECT_EQ(shop.count(RecordKind::RunEnded), 0U);
  const double stands_at = shop.status->position[0];
  EXPECT_EQ(shop.send(shop.command(CommandAction::Resume)).reason, kPressed);

  ASSERT_TRUE(set_emergency_stop(shop, false).accepted);
  const auto end = shop.ended();
  EXPECT_EQ(end.outcome, RunOutcome::Aborted);
  EXPECT_EQ(end.reason, "EMERGENCY STOP");
  EXPECT_EQ(end.executed, 0U);
  EXPECT_FALSE(shop.send(shop.command(CommandAction::Resume)).accepted);
  EXPECT_EQ(shop.status->position[0], stands_at);
}

TEST(EmergencyStop, IsOnRecordBeforeTheRunEnds) {
  Shop shop("1x");
  press_in_motion(shop);
  ASSERT_TRUE(shop.run_until([&] { return shop.count(RecordKind::Stop) == 1; }));
  const dds::Record& record = shop.records.back();
  EXPECT_EQ(record.text, "emergency stop");
  EXPECT_EQ(record.run, "run-1");
  EXPECT_EQ(record.line, 1U);
  ASSERT_TRUE(set_emergency_stop(shop, true).accepted);
  ASSERT_TRUE(set_emergency_stop(shop, false).accepted);
  shop.ended();
  EXPECT_EQ(shop.count(RecordKind::Stop), 1U);
}

TEST(EmergencyStop, LetsNoRunBeginWhileItIsPressed) {
  Shop shop("1x");
  shop.push("O1", "X4\nEND\n");
  ASSERT_TRUE(set_emergency_stop(shop, true).accepted);
  const auto refused = shop.start("O1");
  EXPECT_FALSE(refused.accepted);
  EXPECT_EQ(refused.reason, kPressed);
  ASSERT_TRUE(shop.run_until([&] { return shop.status->message == "EMERGENCY STOP"; }));
  EXPECT_EQ(shop.status->execution, Execution::Stopped);
  EXPECT_TRUE(shop.records.empty());
  ASSERT_TRUE(set_emergency_stop(shop, false).accepted);
  ASSERT_TRUE(shop.run_until([&] { return shop.status->message.empty(); }));
  EXPECT_EQ(shop.status->execution, Execution::Ready);
  ASSERT_TRUE(shop.start("O1").accepted);
  EXPECT_EQ(shop.ended().outcome, RunOutcome::Completed);
}

TEST(EmergencyStop, EndsARunThatWaitsForItsOperator) {
  Shop shop;
  shop.push("O1", "ASK DEPTH\nEND\n");
  ASSERT_TRUE(shop.start("O1").accepted);
  ASSERT_TRUE(shop.run_until([&] { return shop.status->execution == Execution::Waiting; }));
  ASSERT_TRUE(set_emergency_stop(shop, true).accepted);
  ASSERT_TRUE(set_emergency_stop(shop, false).accepted);
  EXPECT_EQ(shop.ended().reason, "EMERGENCY STOP");
}

TEST(EmergencyStop, OfAnAbortedRunLeavesTheNextOnesReasonAlone) {
  Shop shop("1x");
  press_in_motion(shop);
  ASSERT_TRUE(set_emergency_stop(shop, false).accepted);
  shop.ended();
  ASSERT_TRUE(shop.start("O1").accepted);
  ASSERT_TRUE(shop.send(shop.command(CommandAction::Abort)).accepted);
  EXPECT_EQ(shop.ended().reason, "aborted by command");
}

TEST(EmergencyStop, TurnsSpindleAndCoolantOfATncOff) {
  Shop shop(interpreter::kTnc155Dialect, {}, "1x");
  shop.push("7",
            "0 BEGIN PGM 7 MM\n1 TOOL CALL 0 Z S 500,000\n2 L Z+50,000 R0 F9999 M13\n"
            "3 L X+400,000 R0 F500 M\n4 END PGM 7 MM\n");
  ASSERT_TRUE(shop.start("7").accepted);
  ASSERT_TRUE(shop.run_until([&] { return shop.status && shop.status->line == 4; }));
  EXPECT_GT(shop.status->spindle_rpm, 0);
  EXPECT_TRUE(shop.status->modes->flood);
  ASSERT_TRUE(set_emergency_stop(shop, true).accepted);
  ASSERT_TRUE(shop.run_until([&] { return shop.status->feed_mm_per_min == 0; }));
  EXPECT_EQ(shop.status->spindle_rpm, 0);
  EXPECT_FALSE(shop.status->modes->flood);
}

}  // namespace
}  // namespace dripline::gateway
