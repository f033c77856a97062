// A restart that meets faults and other hands: nothing moves, the reason is named, and it can be
// stopped.
#include "tests/unit/gateway/app/restart/restart_faults.hpp"

namespace dripline::gateway {
namespace {

using dds::CommandAction;
using dds::RunOutcome;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST_F(RestartFaults, ALinkCutWhileLookingThroughIsNamedAndWaits) {
  abort_at_stop();
  restart_without_text();
  EXPECT_GT(shop.gateway->turn(shop.clock.steady), shop.clock.steady) << "it waits, and rests";
  shop.connect(false);
  ASSERT_TRUE(shop.run_until([&] { return says("waiting for its text: no server"); }));
  EXPECT_EQ(shop.panel("cycle-start").rfind("refused the restart still looks through", 0), 0u);
  shop.serves_text = true;
  shop.connect(true);
  ASSERT_TRUE(shop.run_until([&] { return says("waiting for cycle start"); }));
  shop.path.clear();
  ASSERT_TRUE(shop.cycle_start());
  ASSERT_TRUE(shop.run_until([&] { return has_ended(2); }));
  EXPECT_EQ(shop.last_end().outcome, RunOutcome::Completed) << shop.last_end().reason;
}

TEST_F(RestartFaults, IsStoppedAtThePanelWithoutALink) {
  abort_at_stop();
  restart_without_text();
  shop.connect(false);
  EXPECT_EQ(shop.panel("abort"), "ok");
  shop.serves_text = true;
  shop.connect(true);
  ASSERT_TRUE(shop.run_until([&] { return has_ended(2); }));
  EXPECT_EQ(shop.last_end().outcome, RunOutcome::Aborted);
  EXPECT_THAT(shop.path, IsEmpty());
  completes();
}

TEST_F(RestartFaults, EndsWithoutItsText) {
  abort_at_stop();
  restart_without_text();
  shop.clock.steady += std::chrono::seconds(1801);
  ASSERT_TRUE(shop.run_until([&] { return has_ended(2); }));
  EXPECT_THAT(shop.last_end().reason, HasSubstr("its text did not come"));
  EXPECT_THAT(shop.path, IsEmpty());
}

TEST_F(RestartFaults, TheOperatorHasAllTheTimeAfterALongLook) {
  abort_at_stop();
  restart_without_text();
  shop.clock.steady += std::chrono::seconds(1790);
  shop.serves_text = true;
  ASSERT_TRUE(shop.run_until([&] { return says("waiting for cycle start"); }));
  shop.clock.steady += std::chrono::seconds(60);
  (void)shop.run_until([] { return false; });
  EXPECT_FALSE(has_ended(2));
}

TEST_F(RestartFaults, IsAbortedWhileItWaitsForCycleStart) {
  abort_at_stop();
  ASSERT_TRUE(restart().is_object());
  const auto position = shop.status->position;
  abort();
  EXPECT_EQ(shop.status->position, position);
  EXPECT_FALSE(shop.cycle_start()) << "there is nothing to start any more";
  completes();
}

TEST_F(RestartFaults, TheEmergencyStopEndsIt) {
  abort_at_stop();
  ASSERT_TRUE(restart().is_object());
  EXPECT_EQ(shop.panel("emergency-stop on"), "ok");
  EXPECT_FALSE(shop.cycle_start());
  EXPECT_FALSE(has_ended(2));
  EXPECT_EQ(shop.panel("emergency-stop off"), "ok");
  ASSERT_TRUE(shop.run_until([&] { return has_ended(2); }));
  EXPECT_EQ(shop.last_end().reason, "EMERGENCY STOP");
  completes();
}

TEST_F(RestartFaults, TheSameRestartTwiceBeginsOnce) {
  abort_at_stop();
  shop.path.clear();
  dds::Command start = shop.start_command("P");
  start.argument = "restart=" + run;
  dds::Command other = shop.start_command("P");
  other.argument = start.argument;
  ASSERT_TRUE(shop.send(start).accepted);
  EXPECT_THAT(shop.send(other).reason, HasSubstr("busy with run " + start.run));
  EXPECT_TRUE(shop.send(start).accepted) << "the answer is repeated, not the start";
  ASSERT_TRUE(shop.run_until([&] { return says("waiting for cycle start"); }));
  EXPECT_EQ(shop.count(dds::RecordKind::RunStarted), 2u);
}

TEST_F(RestartFaults, AKillWhileLookingThroughLeavesTheFirstRunToRestart) {
  abort_at_stop();
  restart_without_text();
  shop.restart_gateway();
  shop.serves_text = true;
  ASSERT_TRUE(shop.run_until([&] { return has_ended(2); }));
  EXPECT_EQ(shop.last_end().outcome, RunOutcome::Interrupted);
  EXPECT_THAT(shop.path, IsEmpty());
  const std::string first = std::exchange(run, second);
  EXPECT_TRUE(restart().is_null());
  EXPECT_THAT(reason(), AllOf(HasSubstr("no checkpoints of run " + second),
                              HasSubstr("it is a restart of run " + first)));
  run = first;
  completes();
}

TEST_F(RestartFaults, ClocksThatAreHoursApartChangeNothing) {
  shop.clock.step = std::chrono::hours(7);
  run_to_stop();
  shop.clock.step = -std::chrono::hours(5);  // set back in the middle of the run
  abort();
  const auto report = restart();
  ASSERT_TRUE(report.is_object()) << reason();
  EXPECT_EQ(report["after"]["block"], report["cut_off_at"]);
  EXPECT_EQ(report["proof"]["path"], "equal");
  abort();
  completes();
}

TEST_F(RestartFaults, BelongsToItsMachine) {
  abort_at_stop();
  shop.close_gateway();
  auto database = storage::sqlite::Database::open(shop.folder() / "outbox.sqlite").value();
  PresentState now = unchanged(database);
  EXPECT_TRUE(plan_restart(database, {run, {}}, now));
  now.conditions.machine = "lathe-2";
  const auto refused = plan_restart(database, {run, {}}, now);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().what, HasSubstr("the machine was lathe-1, it is lathe-2"));
}

TEST_F(RestartFaults, ALostPositionIsNotContinuedFrom) {
  using machine::PositionTrust;
  abort_at_stop();
  shop.close_gateway();
  auto database = storage::sqlite::Database::open(shop.folder() / "outbox.sqlite").value();
  PresentState now = unchanged(database);
  const auto stored = report::CheckpointStore::find(database, run).value();
  const RunEnding ending = decode_ending(run, stored.ending).value();
  ASSERT_TRUE(ending.stopped_at);
  now.conditions.begun_at = *ending.stopped_at;
  for (const auto trust : {PositionTrust::Kept, PositionTrust::Homed, PositionTrust::Reconnected}) {
    now.trust = trust;
    EXPECT_TRUE(plan_restart(database, {run, {}}, now)) << "the axes are where the run stopped";
  }
  for (const auto trust : {PositionTrust::Unlocked, PositionTrust::Lost}) {
    now.trust = trust;
    EXPECT_FALSE(plan_restart(database, {run, {}}, now)) << "the count of a board is no proof";
  }
  now.conditions.begun_at.set_raw(interpreter::Axis::X,
                                  ending.stopped_at->raw(interpreter::Axis::X) + 0.01);
  for (const auto trust : {PositionTrust::Kept, PositionTrust::Homed}) {
    now.trust = trust;
    EXPECT_TRUE(plan_restart(database, {run, {}}, now)) << "machine coordinates are the same";
  }
  for (const auto trust :
       {PositionTrust::Reconnected, PositionTrust::Unlocked, PositionTrust::Lost}) {
    now.trust = trust;
    const auto refused = plan_restart(database, {run, {}}, now);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().what, AllOf(HasSubstr("home the machine"), HasSubstr("block=")));
    EXPECT_TRUE(plan_restart(database, {run, parse_restart_place("block=1").value()}, now))
        << "named by who has looked";
  }
}

TEST_F(RestartFaults, ACalledProgramThatChangedIsNamed) {
  abort_at_stop();
  called["561"] = kCalledProgram + "(the same moves)\n";
  EXPECT_TRUE(restart().is_null());
  EXPECT_THAT(reason(), AllOf(HasSubstr("the content of called program"), HasSubstr("561")));
  EXPECT_THAT(shop.path, IsEmpty());
  called["561"] = kCalledProgram;
  called["562"] = kCalledLater + "(read ahead)\n";
  EXPECT_TRUE(restart("N20").is_null()) << "interpreted, not executed";
  EXPECT_THAT(reason(), AllOf(HasSubstr("the content of called program"), HasSubstr("562")));
  called["562"] = kCalledLater;
  called.erase("561");
  EXPECT_TRUE(restart().is_null());
  EXPECT_THAT(reason(), HasSubstr("is not in the library any more"));
  called["561"] = kCalledProgram;
  completes();
}

// The content of a program is on record before a block of it is executed.
TEST_F(RestartFaults, ACalledProgramThatChangedIsNamedAfterAKillInItsFirstBlock) {
  shop.set_checkpoint_interval(std::chrono::hours(1));
  shop.restart_gateway();
  const std::uint64_t first_in_called = 11;
  ASSERT_TRUE(shop.start_program("P").accepted);
  run = shop.last_run();
  ASSERT_TRUE(shop.run_until_killed_after(first_in_called));
  ASSERT_TRUE(shop.run_until([&] { return has_ended(1); }));
  ASSERT_EQ(shop.last_end().executed, first_in_called);
  called["561"] = kCalledProgram + "(the same moves)\n";
  EXPECT_TRUE(restart().is_null());
  EXPECT_THAT(reason(), AllOf(HasSubstr("the content of called program"), HasSubstr("561")));
}

TEST_F(RestartFaults, ACalledProgramThatChangesWhileItIsReadEndsTheRun) {
  std::string longer = "O0561\n";
  for (int i = 0; i < 40'000; ++i) longer += "G91 X0\n";
  longer += "M99\n";
  std::size_t reads = 0;
  shop.loader = [&](std::string_view) -> std::optional<std::string> {
    std::string text = longer;
    if (++reads > 1) text.back() = ' ';  // of the same length
    return text;
  };
  ASSERT_TRUE(shop.start_program("P").accepted);
  ASSERT_TRUE(shop.run_on());
  EXPECT_GT(reads, 1u);
  EXPECT_EQ(shop.last_end().outcome, RunOutcome::Alarmed);
  EXPECT_THAT(shop.last_end().reason, HasSubstr("another content"));
}

// A cut is worth more than a checkpoint.
TEST_F(RestartFaults, AFullDiskStopsCheckpointsAndNotTheMachine) {
  std::string text = "O1\nG91\n";
  for (int i = 0; i < 400; ++i) text += i % 2 == 0 ? "G01 X5. F3000\n" : "X-5.\n";
  text += "M30\n";
  shop.outbox_bytes = 128 * 1024;
  shop.set_checkpoint_interval(std::chrono::milliseconds(20));
  shop.push("P", text);
  shop.restart_gateway();
  ASSERT_TRUE(shop.start_program("P").accepted);
  run = shop.last_run();
  constexpr std::uint64_t kBlocks = 400;
  std::uint64_t executed = 0;
  ASSERT_TRUE(shop.run_until([&] {
    executed = std::max(executed, shop.status->executed);
    return executed >= kBlocks || shop.status->waits_for == dds::WaitsFor::Disk || has_ended(1);
  }));
  EXPECT_GE(executed, kBlocks) << shop.status->message;
  shop.close_gateway();
  auto database = storage::sqlite::Database::open(shop.folder() / "outbox.sqlite").value();
  const auto kept = report::CheckpointStore::list(database, run).value();
  ASSERT_FALSE(kept.empty());
  EXPECT_LT(kept.back().executed, kBlocks / 2) << "the disk was not full";
}

}  // namespace
}  // namespace dripline::gateway
