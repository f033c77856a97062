// A test run at the gateway: the program is run through with the machine's limits and the control's
// memory, and nothing of it reaches the machine, the memory or the report.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gateway/machine/grbl/grbl_machine.hpp"
#include "tests/support/grbl/board.hpp"
#include "tests/unit/gateway/app/position_fixture.hpp"
#include "tests/unit/gateway/app/toy_control.hpp"
#include "tests/unit/gateway/app/toy_motion.hpp"

namespace dripline::gateway {
namespace {

using dds::CommandAction;
using dds::RunOutcome;
using dds::SwitchState;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class TestRun : public testing::Test {
 protected:
  Shop& at(const interpreter::Dialect& control, const std::string& toml = "",
           const std::string& speed = "max") {
    return *(shop_ = std::make_unique<Shop>(control, toml, speed));
  }
  dds::CommandResult turn(bool is_on, const std::string& name = "test_run") {
    dds::Command asked = shop_->command(CommandAction::Switch);
    asked.run.clear();
    asked.argument = name;
    asked.value = is_on ? 1 : 0;
    return shop_->send(asked);
  }
  /// How it ended, with its reason.
  std::string test(const std::string& text) {
    const std::string reason = shop_->run(text);
    if (reason.starts_with("refused")) return reason;
    return fmt::format("{}: {}", dds::to_string(end().outcome), reason);
  }
  dds::RunEndText end() const { return *dds::decode_run_end(shop_->records.back().text); }

  std::unique_ptr<Shop> shop_;
};

constexpr const char* kPrintsAndCounts =
    "O1\nG21 G90 F600.\nG1 X60.\n#500=#500+1\nDPRNT[P#500[30]]\nM30\n";

TEST_F(TestRun, MovesReportsAndKeepsNothing) {
  Shop& shop = at(interpreter::kFanucDialect);
  ASSERT_EQ(shop.run("O1\nG21 G90 G1 X7. F600\n#500=0\nM30\n"), "completed");
  ASSERT_TRUE(turn(true).accepted);
  EXPECT_EQ(shop.gateway->status().switches->test_run, SwitchState::On);
  const std::size_t before = shop.records.size();
  EXPECT_EQ(test(kPrintsAndCounts), "tested: test run: 6 blocks, 6.0 s of motion at 100 %");
  EXPECT_EQ(shop.at(0), 7);
  EXPECT_THAT(shop.lines(), IsEmpty());
  std::vector<dds::RecordKind> kinds;
  for (std::size_t i = before; i < shop.records.size(); ++i) kinds.push_back(shop.records[i].kind);
  EXPECT_THAT(kinds, ElementsAre(dds::RecordKind::RunStarted, dds::RecordKind::Message,
                                 dds::RecordKind::RunEnded));
  EXPECT_EQ(end().executed, 0U);
  EXPECT_EQ(end().accepted, 6U);
  EXPECT_FALSE(end().motion_seconds) << "nothing has run: no statistics";
  ASSERT_TRUE(turn(false).accepted);
  EXPECT_EQ(shop.run(kPrintsAndCounts), "completed");
  EXPECT_THAT(shop.lines(), ElementsAre("P   1")) << "the test has not counted";
  EXPECT_EQ(shop.at(0), 60);
}

TEST_F(TestRun, IsWhatItsStartAsksForWithoutTheSwitch) {
  Shop& shop = at(interpreter::kFanucDialect);
  shop.push("1", "O1\nG21 G90 G1 X90. F600\nM30\n");
  dds::Command start = shop.start_command("1");
  start.argument = "test=yes";
  const auto reply = shop.send(start);
  ASSERT_TRUE(reply.accepted) << reply.reason;
  EXPECT_EQ(reply.reason, "test run: nothing moves");
  EXPECT_EQ(shop.ended().outcome, RunOutcome::Tested);
  EXPECT_EQ(shop.at(0), 0);
}

TEST_F(TestRun, FindsWhatIsBeyondTheTravelWithItsLine) {
  Shop& shop = at(interpreter::kRs274NgcDialect);
  interpreter::MachineData stated;
  stated.axes[0] = {.min = -100, .max = 100, .max_rate = {}};
  shop.motion =
      make_motion("simulated", interpreter::kRs274NgcDialect, {.machine = stated}).value();
  shop.restart_gateway();
  ASSERT_TRUE(turn(true).accepted);
  EXPECT_THAT(test("G21 G90 F600\nG1 X50\nX101\nM2\n"),
              AllOf(StartsWith("alarmed: "), HasSubstr("(line 3, found by a test run)")));
  EXPECT_EQ(shop.count(dds::RecordKind::Alarm), 0U) << "the machine has none";
  ASSERT_TRUE(turn(false).accepted);
  EXPECT_EQ(shop.run("G21 G90 F600\nG1 X50\nM2\n"), "completed");
}

TEST_F(TestRun, FindsTheProgramsOwnAlarm) {
  (void)at(interpreter::kRs274NgcDialect);
  ASSERT_TRUE(turn(true).accepted);
  EXPECT_THAT(test("G21 G90 F600\nG1 X50\nG2 X60 R1\nM2\n"),
              AllOf(StartsWith("alarmed: NGC"), HasSubstr("(line 3, found by a test run)")));
}

TEST_F(TestRun, ProbesTheWorkpieceOfTheSetup) {
  Shop& shop = at(interpreter::kRs274NgcDialect,
                  "start = { Z = 20.0 }\n[probe]\nsurface = [{ axis = \"Z\", at = 1.5 }]\n");
  ASSERT_TRUE(turn(true).accepted);
  EXPECT_THAT(test("G21 G90 F600\nG38.2 Z-5 F100\nG1 X[SQRT[#5063-1.4]]\nX[SQRT[1.6-#5063]]\nM2\n"),
              StartsWith("tested: "))
      << "#5063 is where the probe met the workpiece";
  EXPECT_EQ(shop.count(dds::RecordKind::Probe), 0U);
}

TEST_F(TestRun, FindsAProbeMoveBeyondTheTravel) {
  Shop& shop = at(interpreter::kRs274NgcDialect);
  interpreter::MachineData stated;
  stated.axes[2] = {.min = -10, .max = 100, .max_rate = {}};
  shop.motion =
      make_motion("simulated", interpreter::kRs274NgcDialect, {.machine = stated}).value();
  shop.restart_gateway();
  ASSERT_TRUE(turn(true).accepted);
  EXPECT_THAT(test("G21 G90 F600\nG38.2 Z-11 F100\nM2\n"),
              AllOf(StartsWith("alarmed: MCH0001"), HasSubstr("(line 2, found by a test run)")));
}

TEST_F(TestRun, NamesTheSubprogramOfAnAlarm) {
  Shop& shop = at(interpreter::kFanucDialect);
  interpreter::MachineData stated;
  stated.axes[0] = {.min = -100, .max = 100, .max_rate = {}};
  shop.motion = make_motion("simulated", interpreter::kFanucDialect, {.machine = stated}).value();
  shop.restart_gateway();
  shop.push("O9000", "O9000\nG1 X[50.*#1]\nG2 X60. R[5.*#1]\nM99\n");
  ASSERT_TRUE(turn(true).accepted);
  EXPECT_THAT(test("O1\nG21 G90 G94 F600.\nG65 P9000 A3.\nM30\n"),
              AllOf(StartsWith("alarmed: MCH"), HasSubstr("(line 2 of O9000, found by a test")));
  EXPECT_THAT(test("O1\nG21 G90 G94 F600.\nG65 P9000 A.1\nM30\n"),
              AllOf(StartsWith("alarmed: PS023"), HasSubstr("(line 3 of O9000, found by a test")));
}

// A setup of the test gives a cell another number, and the control keeps its own all the same.
TEST_F(TestRun, LeavesTheMemoryToTheSetupOfTheNextRun) {
  Shop& shop = at(interpreter::kFanucDialect);
  const auto datum = [](int x) { return fmt::format("[[offset]]\nname = \"G54\"\nX = {}.0\n", x); };
  shop.server_setup = datum(10);
  ASSERT_EQ(shop.run("O1\nG21 G90 G10 L2 P1 X50.\nM30\n"), "completed");
  shop.server_setup = datum(33);
  ASSERT_TRUE(turn(true).accepted);
  EXPECT_THAT(test("O2\nG21 G90 G54 G1 X0. F600\nM30\n"), StartsWith("tested: "));
  ASSERT_TRUE(turn(false).accepted);
  shop.server_setup = datum(10);
  ASSERT_EQ(shop.run("O2\nG21 G90 G54 G1 X0. F600\nM30\n"), "completed");
  EXPECT_EQ(shop.at(0), 50);
}

TEST_F(TestRun, EndsWhereTheProgramAsksItsOperator) {
  (void)at(toy_control());
  ASSERT_TRUE(turn(true).accepted);
  EXPECT_EQ(test("X5\nASK how many?\nX6\nEND\n"),
            "aborted: test run: good as far as line 2, where the program asks the operator: how "
            "many?: the answer is not known before it runs");
}

TEST_F(TestRun, PassesOverStops) {
  Shop& shop = at(toy_control());
  ASSERT_TRUE(turn(true).accepted);
  EXPECT_THAT(test("X5\nSTOP\nX6\nEND\n"), StartsWith("tested: "));
  EXPECT_EQ(shop.count(dds::RecordKind::Stop), 0U);
}

// Other than a Centurion's VERIFY, in which no byte parameter is written: the copy of the memory
// is.
TEST_F(TestRun, WritesByteParametersAsARunDoesAndWaitsForNoHandwheel) {
  Shop& shop = at(interpreter::kCenturionDialect);
  const std::string text = "O1\nHDW(MOVE X)\nPB7=9\nG98 G1 X1 F100\nM30\n";
  ASSERT_TRUE(turn(true).accepted);
  EXPECT_THAT(test(text), StartsWith("tested: "));
  EXPECT_THAT(test("O2\nPB7=0\nN10 PB7=PB7+1\nIF PB7 LT 3 GOTO 10\nM30\n"),
              StartsWith("tested: test run: 9 blocks"));
  EXPECT_THAT(test("O3\nPB7=300\nM30\n"),
              AllOf(StartsWith("alarmed: CEN0517"), HasSubstr("(line 2, found by a test run)")));
  ASSERT_TRUE(turn(false).accepted);
  ASSERT_EQ(shop.run("O4\nP3=PB7\nPOPEN P0\nDPRNT[A#3]\nPCLOS\nM30\n"), "completed");
  EXPECT_THAT(shop.lines(), ElementsAre(HasSubstr("0"))) << "the test has kept nothing";
  shop.push("2", text);
  ASSERT_TRUE(shop.start("2").accepted);
  EXPECT_TRUE(shop.run_until([&] {
    return shop.gateway->status().execution == dds::Execution::ProgramStopped ||
           shop.gateway->status().execution == dds::Execution::Waiting;
  })) << "a run waits for the handwheel";
}

TEST_F(TestRun, LeavesTheModesOfTheLastRun) {
  Shop& shop = at(interpreter::kRs274NgcDialect);
  ASSERT_EQ(shop.run("G20 G91 G94 F10\nG1 X1\nM2\n"), "completed");
  ASSERT_EQ(shop.mdi("G20 G91 F10\n"), "completed");
  ASSERT_TRUE(turn(true).accepted);
  EXPECT_THAT(test("G21 G90 F600\nG1 X500\nM30\n"), StartsWith("tested: "));
  ASSERT_TRUE(turn(false).accepted);
  ASSERT_EQ(shop.mdi("G1 X1\n"), "completed");
  EXPECT_NEAR(shop.at(0), 50.8, 1e-9) << "another inch, incremental";
}

TEST_F(TestRun, IsRefusedForARestartAndDuringARun) {
  Shop& shop = at(interpreter::kRs274NgcDialect, "", "1x");
  shop.push("1", "G21 G90 F60\nG1 X50\nX0\nM2\n");
  const auto started = shop.start_command("1");
  ASSERT_TRUE(shop.send(started).accepted);
  ASSERT_TRUE(shop.run_until([&] { return shop.status && shop.status->executed > 0; }));
  EXPECT_EQ(turn(true).reason, "test run is changed only without a run: run-1 is active");
  ASSERT_TRUE(shop.send(shop.command(CommandAction::Abort)).accepted);
  ASSERT_EQ(shop.ended().outcome, RunOutcome::Aborted);
  ASSERT_TRUE(turn(true).accepted);
  dds::Command restart = shop.start_command("1");
  restart.argument = "restart=run-1 at=executed";
  EXPECT_THAT(shop.send(restart).reason, HasSubstr("a restart is not tested"));
}

TEST_F(TestRun, WaitsForNothingWhileItWorks) {
  Shop& shop = at(interpreter::kFanucDialect);
  ASSERT_TRUE(turn(true).accepted);
  shop.push("1", "O1\nG21 G90 G94 F600.\nN10 G1 X1.\nX0.\nGOTO 10\nM30\n");
  ASSERT_TRUE(shop.start("1").accepted);
  ASSERT_TRUE(shop.run_until([&] { return shop.gateway->status().accepted > 1000; }));
  EXPECT_EQ(shop.gateway->status().execution, dds::Execution::Waiting);
  EXPECT_EQ(shop.gateway->status().waits_for, dds::WaitsFor::Nothing);
  ASSERT_TRUE(shop.send(shop.command(CommandAction::Abort)).accepted);
}

TEST_F(TestRun, IsAbortedByItsOperatorAndTheEmergencyStop) {
  Shop& shop = at(interpreter::kRs274NgcDialect);
  shop.serves_text = false;  // it waits for its text
  ASSERT_TRUE(turn(true).accepted);
  shop.push("1", "G21 G90 F600\nG1 X500\nM30\n");
  ASSERT_TRUE(shop.start("1").accepted);
  ASSERT_TRUE(shop.run_until([&] { return !shop.gateway->status().run.empty(); }));
  EXPECT_EQ(shop.gateway->status().message, "test run: nothing moves, block 0");
  EXPECT_EQ(shop.gateway->status().waits_for, dds::WaitsFor::Text);
  const auto held = shop.send(shop.command(CommandAction::Hold));
  EXPECT_FALSE(held.accepted);
  EXPECT_EQ(held.reason, "a test run moves nothing, so there is nothing to hold; an abort ends it");
  ASSERT_TRUE(shop.send(shop.command(CommandAction::Abort)).accepted);
  EXPECT_EQ(shop.ended().reason, "test run: aborted by command");
  ASSERT_TRUE(shop.start("1").accepted);
  ASSERT_TRUE(turn(true, "emergency_stop").accepted);
  (void)shop.run_until([&] { return shop.gateway->status().run.empty(); });
  EXPECT_EQ(end().reason, "EMERGENCY STOP");
}

// A person at the machine has nothing to allow: the switch off is what they allow.
TEST_F(TestRun, NeedsNoCycleStart) {
  Shop& shop = at(interpreter::kRs274NgcDialect);
  shop.make_attended();
  shop.restart_gateway();
  ASSERT_TRUE(turn(true).accepted);
  EXPECT_THAT(test("G21 G90 F600\nG1 X500\nM30\n"), StartsWith("tested: "));
  EXPECT_THAT(turn(false).reason, HasSubstr("remote enable"));
  EXPECT_EQ(shop.panel("switch test_run off"), "ok");
  shop.push("9", "G21 G90 F600\nG1 X500\nM30\n");
  ASSERT_TRUE(shop.start("9").accepted);
  ASSERT_TRUE(shop.run_until([&] { return !shop.gateway->status().run.empty(); }));
  EXPECT_EQ(shop.gateway->status().waits_for, dds::WaitsFor::CycleStart);
}

TEST_F(TestRun, GivesADeviceNothing) {
  test_support::GrblBoard board{test_support::GrblBoard::Options{}};
  Shop& shop = at(interpreter::kRs274NgcDialect, "", "1x");
  machine::grbl::GrblMachine* machine = nullptr;
  shop.motion = [&](machine::ExecutionSink& sink) {
    auto made = std::make_unique<machine::grbl::GrblMachine>(machine::grbl::GrblMachine::Settings{
        .sink = sink, .clock = std::shared_ptr<const Clock>(&shop.clock, [](const auto*) {})});
    machine = made.get();
    machine->line_opened();
    return made;
  };
  shop.each_turn = [&] {
    for (int i = 0; i < 10; ++i) {
      board.pass(0.001);
      const std::string in = board.take_output();
      const auto out = machine->exchange(std::as_bytes(std::span(in)));
      board.receive(out.real_time + out.lines);
    }
  };
  shop.restart_gateway();
  ASSERT_TRUE(shop.run_until([&] { return shop.status && machine->notice().empty(); }));
  const auto moves = [&] {
    return std::ranges::count_if(board.lines, [](const std::string& line) {
      return line.starts_with("G0") || line.starts_with("G1");
    });
  };
  ASSERT_TRUE(turn(true).accepted);
  EXPECT_THAT(test("G21 G90 F600\nG1 X5\nX6\nM2\n"), StartsWith("tested: test run: 4 blocks"));
  EXPECT_THAT(test("G21 G90 F600\nG1 X5\nX6 A5\nM2\n"),
              AllOf(StartsWith("alarmed: MCH"), HasSubstr("(line 3, found by a test run)")));
  EXPECT_EQ(moves(), 0);
  ASSERT_TRUE(turn(false).accepted);
  EXPECT_EQ(shop.run("G21 G90 F600\nG1 X5\nM2\n"), "completed");
  EXPECT_GT(moves(), 0);
}

TEST_F(TestRun, IsRefusedWhereTheMachineKnowsNothingBeforehand) {
  Shop& shop = at(toy_control(), "", "1x");
  shop.motion = [](machine::ExecutionSink& sink) { return std::make_unique<ToyMotion>(sink); };
  shop.restart_gateway();
  ASSERT_TRUE(turn(true).accepted);
  EXPECT_EQ(test("X5\nEND\n"), "refused: this machine has no test run");
}

}  // namespace
}  // namespace dripline::gateway
