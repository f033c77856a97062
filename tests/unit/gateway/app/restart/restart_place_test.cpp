// Where a restart continues, what it refuses, and what the operator sees.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gateway/interpreter/core/dialects.hpp"
#include "tests/unit/gateway/app/restart/restart_fixture.hpp"

namespace dripline::gateway {
namespace {

using testing::HasSubstr;

const std::string kProgram =
    "O0540\nT1 M06\nG90 G00 X0 Y0 Z50.\nM03 S900\nM08\n#500=7\n#1=1\nN10 WHILE[#1LE6]DO1\nN20 G01 "
    "X[#1*10] F600\nN30 Y10.\nM98 P0561\n#1=#1+1\nEND1\nN40 T2 M06\nN50 G01 Z-5.\nX0\nM00\nN60 "
    "Y0\nN70 "
    "X90.\nM30\nO0561\nG91 Z-1.\nZ1.\nG90 M99\n";

/// Runs program P up to its stop, and aborts it there. Returns the run.
std::string abort_at_its_stop(RestartFixture& shop) {
  EXPECT_TRUE(shop.start_program("P").accepted);
  EXPECT_TRUE(shop.run_until(
      [&] { return shop.status && shop.status->execution == dds::Execution::ProgramStopped; }));
  EXPECT_TRUE(shop.send(shop.command(dds::CommandAction::Abort)).accepted);
  EXPECT_TRUE(shop.run_on());
  EXPECT_EQ(shop.last_end().outcome, dds::RunOutcome::Aborted);
  return shop.last_run();
}

class Restart : public testing::Test {
 protected:
  Restart() : shop(interpreter::kFanucDialect, {}, "20x") {
    shop.set_checkpoint_interval(std::chrono::milliseconds(200));
    shop.push("P", kProgram);
    shop.restart_gateway();
  }
  /// Up to the stop before N60.
  void abort_at_stop() { run = abort_at_its_stop(shop); }
  nlohmann::json restart(const std::string& at = "executed") {
    shop.path.clear();
    return shop.begin_restart("P", run, at);
  }
  /// Aborts the restart that was only looked at.
  void leave() {
    ASSERT_TRUE(shop.send(shop.command(dds::CommandAction::Abort)).accepted);
    ASSERT_TRUE(shop.run_on());
  }

  RestartFixture shop;
  std::string run;
};

TEST_F(Restart, ShowsWhatItWillDoBeforeItMoves) {
  abort_at_stop();
  shop.restart_gateway();  // the simulated axes are at their start again
  const auto report = restart();
  ASSERT_TRUE(report.is_object()) << shop.start_answer.reason;
  EXPECT_EQ(report["restart_of"], run);
  EXPECT_EQ(report["switched_on"]["spindle"], "cw");
  EXPECT_EQ(report["switched_on"]["rpm"], 900);
  EXPECT_EQ(report["switched_on"]["flood"], true);
  EXPECT_EQ(report["tool"]["number"], 2);
  EXPECT_EQ(report["continues_at"]["Z"], -5);
  EXPECT_EQ(report["continues_at"]["Y"], 10);
  EXPECT_EQ(report["approach"][0]["to"]["Z"], 50) << "over the highest place of the program";
  EXPECT_EQ(report["next"]["n"], 60);
  EXPECT_EQ(report["next"]["length_mm"], 10);
  EXPECT_EQ(report["proof"]["path"], "equal");
  const auto position = shop.status->position;
  (void)shop.run_until([] { return false; });  // a minute
  EXPECT_EQ(shop.status->position, position) << "nothing moves before cycle start";
  EXPECT_EQ(shop.status->waits_for, dds::WaitsFor::CycleStart);
  EXPECT_EQ(shop.status->modes->spindle, dds::SpindleState::Off);
  ASSERT_TRUE(shop.cycle_start());
  ASSERT_TRUE(shop.run_on());
  EXPECT_EQ(shop.last_end().outcome, dds::RunOutcome::Completed) << shop.last_end().reason;
}

TEST_F(Restart, ContinuesWhereItWasExecutedLast) {
  abort_at_stop();
  for (const auto& [at, n] : {std::pair{"N30", 30}, {"N50", 50}, {"N20", 20}, {"L10", 30}}) {
    const auto report = restart(at);
    ASSERT_TRUE(report.is_object()) << at << shop.start_answer.reason << shop.last_end().reason;
    EXPECT_EQ(report["next"]["n"], n) << at;
    if (std::string_view(at) == "N30") {
      EXPECT_EQ(report["continues_at"]["X"], 60) << "of the last pass of the loop";
    }
    leave();
  }
}

/// The next block relies on where the probe has stopped the axes, and does not name it.
TEST(ProbingRestart, ContinuesWhereTheProbeMoveEnded) {
  interpreter::Setup setup;
  setup.workpiece.add(interpreter::ProbePlane{interpreter::Axis::Z, Length::mm(-10)});
  RestartFixture shop(interpreter::kFanucDialect, setup, "20x");
  shop.push(
      "P", "O0541\nG21 G90 G00 X10. Y0 Z5.\nG31 Z-20. F100\n#1=5\nM00\nG01 X20. F200\nY20.\nM30\n");
  shop.restart_gateway();
  const std::string run = abort_at_its_stop(shop);
  shop.restart_gateway();  // the simulated axes are at their start again
  const auto report = shop.begin_restart("P", run);
  ASSERT_TRUE(report.is_object()) << shop.start_answer.reason;
  EXPECT_EQ(report["continues_at"]["X"], 10);
  EXPECT_EQ(report["continues_at"]["Z"], -10);
  EXPECT_EQ(report["approach"][0]["to"]["Z"], 5) << "over the highest place of the program";
  EXPECT_EQ(report["proof"]["path"], "equal");
  ASSERT_TRUE(shop.cycle_start());
  ASSERT_TRUE(shop.run_on());
  EXPECT_EQ(shop.last_end().outcome, dds::RunOutcome::Completed) << shop.last_end().reason;
  EXPECT_EQ(shop.status->position[2], -10) << "X20 and Y20 were cut at that depth";
}

/// A block that names where the axes are already moves none of them.
TEST_F(Restart, BringsBackAnAxisThatTheProgramHadNotMovedYet) {
  shop.push("P",
            "O0541\nG21 G90 G00 Z50.\nN20 X0 Y0\nN30 G01 Z-2. F600\nN40 X20.\nN50 Y30.\nM00\n"
            "N60 X40.\nG00 Z50.\nM30\n");
  shop.restart_gateway();
  abort_at_stop();  // at X20 Y30 Z-2
  const auto report = restart("N40");
  ASSERT_TRUE(report.is_object()) << shop.start_answer.reason;
  EXPECT_EQ(report["position"], (nlohmann::json{{"X", 20}, {"Y", 30}, {"Z", -2}}));
  EXPECT_EQ(report["continues_at"], (nlohmann::json{{"X", 0}, {"Y", 0}, {"Z", -2}}));
  EXPECT_EQ(report["approach"][0]["to"], (nlohmann::json{{"Z", 50}}));
  EXPECT_EQ(report["approach"][1]["to"], (nlohmann::json{{"X", 0}, {"Y", 0}}));
  ASSERT_TRUE(shop.cycle_start());
  ASSERT_TRUE(shop.run_until(
      [&] { return shop.status && shop.status->execution == dds::Execution::ProgramStopped; }));
  ASSERT_TRUE(shop.send(shop.command(dds::CommandAction::Abort)).accepted);
  ASSERT_TRUE(shop.run_on());
  run = shop.last_run();  // and again, after the place that it was brought to
  const auto again = restart("N50");
  ASSERT_TRUE(again.is_object()) << shop.start_answer.reason;
  EXPECT_EQ(again["continues_at"], (nlohmann::json{{"X", 20}, {"Y", 0}, {"Z", -2}}));
}

/// A rapid up would tear the tap off.
TEST_F(Restart, LeavesATapInItsHoleToTheOperator) {
  shop.push("P",
            "O0543\nG21 G90 G00 Z50. M03 S200\nN30 X10. Y5.\nN40 G84 Z-20. R5. F150\nN50 G80\n"
            "M30\n");
  shop.restart_gateway();
  ASSERT_TRUE(shop.start_program("P").accepted);
  run = shop.last_run();
  ASSERT_TRUE(shop.run_until([&] { return shop.status && shop.status->position[2] < 0; }));
  ASSERT_TRUE(shop.send(shop.command(dds::CommandAction::Abort)).accepted);
  ASSERT_TRUE(shop.run_on());
  EXPECT_TRUE(restart().is_null());
  EXPECT_THAT(shop.last_end().reason, HasSubstr("the tool stopped in a thread"));
  shop.restart_gateway();  // its axes are elsewhere then: it was retracted
  EXPECT_TRUE(restart().is_object()) << shop.last_end().reason;
}

TEST_F(Restart, GoesBackOverTheHighestPlaceSince) {
  shop.push("P",
            "O0542\nG21 G90 G00 Z5.\nN20 X20. Y5.\nN30 G01 Z-2. F600\nN40 X30.\nN50 G00 Z100.\n"
            "N60 X200. Y10.\nN70 Z5.\nG01 Z-2.\nM00\nN80 X205.\nM30\n");
  shop.restart_gateway();
  for (const char* at : {"N40", "block=5"}) {
    abort_at_stop();
    const auto report = restart(at);
    ASSERT_TRUE(report.is_object()) << shop.start_answer.reason;
    EXPECT_EQ(report["approach"][0]["to"], (nlohmann::json{{"Z", 100}})) << report;
    leave();
  }
}

TEST_F(Restart, ContinuesAtAToolChange) {
  abort_at_stop();
  const auto report = restart("T2");
  ASSERT_TRUE(report.is_object()) << shop.start_answer.reason << shop.last_end().reason;
  EXPECT_EQ(report["tool"]["number"], 1) << "the change itself is executed again";
  EXPECT_EQ(report["next"]["n"], 40);
}

TEST_F(Restart, ContinuesInASubprogramOfAnEarlierPass) {
  abort_at_stop();
  const auto whole = shop.path;
  const std::uint64_t executed = shop.last_end().executed;
  const auto report = restart("block=30");
  ASSERT_TRUE(report.is_object()) << shop.start_answer.reason << shop.last_end().reason;
  EXPECT_EQ(report["after"]["block"], 29);
  EXPECT_EQ(report["cut_off_at"], executed);
  EXPECT_EQ(report["proof"]["state"], "equal");
  ASSERT_TRUE(shop.cycle_start());
  ASSERT_TRUE(shop.run_on());
  EXPECT_EQ(shop.last_end().outcome, dds::RunOutcome::Completed);
}

TEST_F(Restart, ARestartCanBeRestarted) {
  abort_at_stop();
  ASSERT_TRUE(restart("N50").is_object());
  const std::string second = shop.last_run();
  shop.restart_gateway();  // killed before its cycle start
  ASSERT_TRUE(shop.run_until([&] { return shop.count(dds::RecordKind::RunEnded) == 2; }));
  shop.path.clear();
  const auto report = shop.begin_restart("P", second);
  ASSERT_TRUE(report.is_object()) << shop.start_answer.reason << shop.last_end().reason;
  EXPECT_EQ(report["next"]["n"], 50);
}

TEST_F(Restart, RefusesWhatItCannotContinue) {
  abort_at_stop();
  const auto refusal = [&](const std::string& at) {
    EXPECT_TRUE(restart(at).is_null()) << at;
    return shop.start_answer.accepted ? shop.last_end().reason : shop.start_answer.reason;
  };
  EXPECT_THAT(refusal("block=100000"), HasSubstr("blocks; it continues at"));
  EXPECT_THAT(refusal("N70"), HasSubstr("N70 is not among the"));
  EXPECT_THAT(refusal("T9"), HasSubstr("T9 is not among the"));
  EXPECT_THAT(refusal("time=2001-01-01T00:00:00Z"), HasSubstr("began at"));
  EXPECT_THAT(refusal("nowhere"), HasSubstr("names no place"));
  run = "run-99";
  EXPECT_THAT(refusal("executed"), HasSubstr("no checkpoints of run run-99"));
}

TEST_F(Restart, IsRefusedForACompletedRun) {
  ASSERT_TRUE(shop.start_program("P").accepted);
  run = shop.last_run();
  ASSERT_TRUE(shop.run_on());
  ASSERT_EQ(shop.last_end().outcome, dds::RunOutcome::Completed) << shop.last_end().reason;
  EXPECT_TRUE(restart().is_null());
  EXPECT_THAT(shop.start_answer.reason, HasSubstr("was completed"));
}

TEST_F(Restart, IsRefusedWithTheNameOfWhatHasChanged) {
  abort_at_stop();
  dds::Command start = shop.start_command("P");
  start.argument = "restart=" + run;
  start.setup = "[[tool]]\nnumber = 1\nradius = 4.0\n";
  EXPECT_THAT(shop.send(start).reason, HasSubstr("the machine's setup on the server"));

  shop.push("P", kProgram + "\n");
  EXPECT_TRUE(restart().is_null());
  EXPECT_THAT(shop.start_answer.reason, HasSubstr("the program's content was"));
  shop.push("P", kProgram);

  dds::Command skip = shop.command(dds::CommandAction::Switch);
  skip.argument = "block_skip";
  skip.value = 1;
  ASSERT_TRUE(shop.send(skip).accepted);
  EXPECT_TRUE(restart().is_null());
  EXPECT_THAT(shop.start_answer.reason, HasSubstr("the switch block_skip was off, it is on"));
  skip = shop.command(dds::CommandAction::Switch);
  skip.argument = "block_skip";
  ASSERT_TRUE(shop.send(skip).accepted);

  shop.push("OTHER", "O1\n#500=8\nM30\n");
  ASSERT_TRUE(shop.start_program("OTHER").accepted);
  ASSERT_TRUE(shop.run_on());
  EXPECT_TRUE(restart().is_null());
  EXPECT_THAT(shop.start_answer.reason, HasSubstr("the control's memory"));
}

/// A run of a program whose block N10 is skipped from the change on, and which is aborted after it.
class RestartAfterASkip : public testing::Test {
 protected:
  RestartAfterASkip() : shop(interpreter::kFanucDialect, {}, "1000x") {
    std::string text = "O0541\nG21 G90 F6000\nG01 X1.\nM00\n";
    for (int i = 0; i < 40'000; ++i) text += "X" + std::to_string(i % 2) + ".\n";
    text += "/N10 X90.\nN20 X5.\nM00\nX6.\nM30\n";
    shop.set_checkpoint_interval(std::chrono::milliseconds(200));
    shop.push("P", text);
    shop.restart_gateway();
  }
  bool at_stop() {
    return shop.run_until(
        [&] { return shop.status && shop.status->execution == dds::Execution::ProgramStopped; });
  }
  void turn_skip(bool is_on) {
    dds::Command skip = shop.command(dds::CommandAction::Switch);
    skip.argument = "block_skip";
    skip.value = is_on ? 1 : 0;
    ASSERT_TRUE(shop.send(skip).accepted);
  }
  /// Why a restart does not begin; empty: it does.
  std::string refusal(const std::string& at = "executed") {
    if (!shop.begin_restart("P", run, at).is_null()) return {};
    return shop.start_answer.accepted ? shop.last_end().reason : shop.start_answer.reason;
  }

  RestartFixture shop;
  std::string run;
};

TEST_F(RestartAfterASkip, IsRefusedWithTheSwitchAndWhatToDo) {
  ASSERT_TRUE(shop.start_program("P").accepted);
  run = shop.last_run();
  ASSERT_TRUE(at_stop());
  turn_skip(true);
  ASSERT_TRUE(shop.cycle_start());
  ASSERT_TRUE(shop.run_until([&] { return shop.status->executed > 39'000; }));
  ASSERT_TRUE(at_stop());
  ASSERT_TRUE(shop.send(shop.command(dds::CommandAction::Abort)).accepted);
  ASSERT_TRUE(shop.run_on());
  EXPECT_THAT(refusal(),
              testing::AllOf(HasSubstr("the switch block_skip was off at its start"),
                             HasSubstr("within the run switch block_skip on after block"),
                             HasSubstr("(--from)")));
  shop.restart_gateway();  // as after a kill: it is on record
  turn_skip(false);
  EXPECT_THAT(refusal(),
              testing::AllOf(HasSubstr("within the run switch block_skip on after block"),
                             HasSubstr("(--from)")));
  EXPECT_EQ(refusal("block=3"), "") << "before the change";
}

TEST_F(RestartAfterASkip, NeedsTheSwitchAsItWasFromTheFirstBlockOn) {
  shop.make_attended();
  shop.restart_gateway();
  ASSERT_TRUE(shop.start_program("P").accepted);
  run = shop.last_run();
  EXPECT_EQ(shop.panel("switch block_skip on"), "ok from the first block on");
  EXPECT_EQ(shop.panel("cycle-start"), "ok");
  ASSERT_TRUE(at_stop());
  EXPECT_EQ(shop.panel("abort"), "ok");
  ASSERT_TRUE(shop.run_on());
  EXPECT_EQ(refusal(), "");
}

TEST_F(Restart, NothingStartsFromADamagedCheckpoint) {
  abort_at_stop();
  shop.close_gateway();
  {
    auto database = storage::sqlite::Database::open(shop.folder() / "outbox.sqlite").value();
    ASSERT_TRUE(database.execute(
        "UPDATE checkpoint SET bytes = CAST(substr(bytes, 1, 40) || x'7f' || substr(bytes, 42) AS "
        "BLOB)"));
  }
  shop.restart_gateway();
  EXPECT_TRUE(restart().is_null());
  const std::string why =
      shop.start_answer.accepted ? shop.last_end().reason : shop.start_answer.reason;
  EXPECT_THAT(why, HasSubstr("is not as it was written"));
  EXPECT_TRUE(shop.path.empty()) << "nothing was given to the machine";
}

/// The end of its block is known only from the next ones, which end the compensation.
TEST(CompensatedRestart, ShowsTheModesOfTheBlockThatIsExecuted) {
  const auto setup = interpreter::parse_setup("[[tool]]\nnumber = 1\nradius = 4.0\n");
  ASSERT_TRUE(setup) << setup.error().what;
  RestartFixture shop(interpreter::kFanucDialect, *setup, "20x");
  shop.set_checkpoint_interval(std::chrono::milliseconds(200));
  shop.push("P",
            "O0541\nG90 G00 X-15. Y-15.\nN20 G41 G01 X0 Y0 D1 F300\nN30 Y60.\n"
            "N40 G40 X-20. F600\nN50 Y0\nM30\n");
  shop.restart_gateway();
  ASSERT_TRUE(shop.start_program("P").accepted);
  const std::string run = shop.last_run();
  ASSERT_TRUE(shop.run_until([&] { return shop.status && shop.status->position[1] > 20; }));
  ASSERT_TRUE(shop.send(shop.command(dds::CommandAction::Abort)).accepted);
  ASSERT_TRUE(shop.run_on());
  const auto report = shop.begin_restart("P", run);
  ASSERT_TRUE(report.is_object()) << shop.start_answer.reason << shop.last_end().reason;
  EXPECT_EQ(report["next"]["n"], 30);
  EXPECT_EQ(report["modes"]["compensation"], "left");
  ASSERT_TRUE(shop.cycle_start());
  const auto executes = [&](int n, bool is_compensated) {
    return shop.run_until([&] {
      const auto shown = is_compensated ? dds::CompensationSide::Left : dds::CompensationSide::Off;
      return shop.status && shop.status->modes && shop.status->sequence == n &&
             shop.status->modes->compensation == shown;
    });
  };
  EXPECT_TRUE(executes(30, true));
  EXPECT_TRUE(executes(50, false));
}

/// With a head the approach along Z would lead a tilted tool through the part, in or out.
TEST(RestartOfAHead, IsRefusedWhereTheToolIsTilted) {
  const auto setup = interpreter::parse_setup(
      "[control]\nmodel = \"30i\"\nkinematics = \"head-head\"\nrotary_master = \"C+\"\n"
      "rotary_slave = \"A+\"\nhead_centers = [ { X = 0.0, Y = 0.0 }, { Y = 0.0, Z = 100.0 } ]\n");
  ASSERT_TRUE(setup) << setup.error().what;
  RestartFixture shop(interpreter::kFanucDialect, *setup, "20x");
  shop.set_checkpoint_interval(std::chrono::milliseconds(200));
  shop.push("P",
            "O0541\nN10 G90 G00 X0 Y0 Z50.\nN20 X10.\nN30 G68.2 X0 Y0 Z0 I0 J60. K0\nN40 G53.1\n"
            "N50 G01 X5. Y5. Z-5. F600\nN60 M00\nN70 X20.\nG69\nM30\n");
  shop.restart_gateway();
  const std::string run = abort_at_its_stop(shop);
  // from the tilted axes back to where they were not
  EXPECT_FALSE(shop.begin_restart("P", run, "N20").is_object());
  EXPECT_THAT(shop.last_end().reason, HasSubstr("tilted where the axes are"));
  // without a move nothing is in the way
  ASSERT_TRUE(shop.begin_restart("P", run).is_object()) << shop.last_end().reason;
  ASSERT_TRUE(shop.send(shop.command(dds::CommandAction::Abort)).accepted);
  ASSERT_TRUE(shop.run_on());
  shop.restart_gateway();  // the simulated axes are at their start again
  EXPECT_FALSE(shop.begin_restart("P", run).is_object());
  EXPECT_THAT(shop.last_end().reason, HasSubstr("tilted at the place"));
  EXPECT_TRUE(shop.begin_restart("P", run, "N20").is_object()) << shop.last_end().reason;
}

}  // namespace
}  // namespace dripline::gateway
