#include "tests/unit/gateway/machine/grbl/grbl_shop.hpp"

/// What a program does, on a board that behaves.
namespace dripline::machine::grbl::test {
namespace {

TEST(GrblMachine, KnowsTheBoardAfterConnecting) {
  GrblShop shop({.axes = 4});
  EXPECT_EQ(shop.machine.capabilities().axes.count(), 4U);
  EXPECT_TRUE(shop.machine.capabilities().arcs);
  EXPECT_FALSE(shop.machine.capabilities().threads);
  EXPECT_FALSE(shop.machine.capabilities().places_axes);
  const auto ready = shop.machine.check_begin({});
  EXPECT_TRUE(ready) << ready.error().what;
}

TEST(GrblMachine, RefusesAStartElsewhere) {
  GrblShop shop({.start = {3, 0, 0, 0}});
  EXPECT_EQ(shop.machine.check_begin({}).error().what, "X is at 3.000, the setup begins at 0.000");
  EXPECT_TRUE(shop.machine.check_begin(Program::at(3, 0)));
}

TEST(GrblMachine, RefusesABoardThatIsNotReady) {
  GrblShop locked({.is_locked = true});
  EXPECT_EQ(locked.machine.check_begin({}).error().what,
            "the board is in alarm: home the axes ($H), or unlock it ($X)");
  GrblShop laser({.settings = {{32, "1"}}});
  EXPECT_NE(laser.machine.check_begin({}).error().what.find("laser"), std::string::npos);
  GrblShop check;
  check.board.enter_check_mode();
  check.pass(1);
  EXPECT_NE(check.machine.check_begin({}).error().what.find("check mode"), std::string::npos);
  GrblShop door;
  door.board.open_door();
  door.pass(1);
  EXPECT_EQ(door.machine.check_begin({}).error().what, "the safety door is open");
}

struct BoardCase {
  const char* name;
  GrblBoard::Options options;
};
class EveryBoard : public testing::TestWithParam<BoardCase> {};

TEST_P(EveryBoard, RunsAProgramAndCountsOnlyWhatIsDone) {
  GrblShop shop(GetParam().options);
  shop.checks_truth = true;
  shop.silent_blocks = 1;  // the end
  shop.begin();
  for (int i = 1; i <= 120; ++i) shop.program.line(i * 0.5, -(i % 7), 3000);
  shop.program.end();
  ASSERT_TRUE(shop.pass_until_over()) << shop.x();
  EXPECT_EQ(shop.alarm(), "");
  EXPECT_EQ(shop.machine.state(), MachineState::Completed);
  EXPECT_EQ(shop.recorder.blocks.size(), 121U);
  EXPECT_EQ(shop.recorder.lines.back(), "end");
  EXPECT_TRUE(shop.machine.drained());
  EXPECT_NEAR(shop.x(), 60, 1e-3);
  EXPECT_FALSE(shop.board.has_overrun);
  EXPECT_EQ(shop.board.done.size(), 120U);
}

TEST_P(EveryBoard, RunsArcs) {
  GrblShop shop(GetParam().options);
  shop.begin();
  shop.program.rapid(10, 0);
  shop.program.arc(10, 0, 0, 0, 360, 3000);
  shop.program.arc(-10, 0, 0, 0, 180, 3000);
  shop.program.end();
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.alarm(), "");
  EXPECT_NEAR(shop.x(), -10, 1e-3);
  EXPECT_NEAR(shop.board.traveled(), 10 + 30 * Angle::kPi, 0.2) << "one circle and a half";
}

INSTANTIATE_TEST_SUITE_P(
    , EveryBoard,
    testing::Values(BoardCase{"grbl_with_line_numbers", {}},
                    BoardCase{"grbl_with_buffers_alone", {.has_line_numbers = false}},
                    BoardCase{"grbl_with_line_numbers_alone", {.reports_buffers = false}},
                    BoardCase{"grbl_that_reports_work_position", {.reports_work_position = true}},
                    BoardCase{"grbl_hal",
                              {.rx_bytes = 1024, .planner_blocks = 100, .is_grbl_hal = true}}),
    [](const auto& i) { return std::string(i.param.name); });

TEST(GrblMachine, WritesNoLineThatTheBoardCannotRead) {
  GrblShop shop;
  shop.begin();
  shop.program.rapid(-123.4567, 0);
  shop.program.arc(-123.4567, -876.5432, -438.2716, -123.4567, 180, 2999.999);
  shop.program.end();
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.alarm(), "");
  EXPECT_LE(shop.board.longest_line(), 79U);
}

TEST(GrblMachine, KeepsTheOrderOfMotionAndEverythingElse) {
  GrblShop shop;
  shop.begin();
  shop.program.spindle(1200);
  shop.program.line(1, 0, 600);
  shop.program.output("A");
  shop.program.line(2, 0, 600);
  shop.program.dwell(0.5);
  shop.program.output("B");
  shop.program.end();
  EXPECT_TRUE(shop.pass_until([&] { return shop.has("output A"); }));
  EXPECT_NEAR(shop.board.position()[0], 1, 1e-6) << "the motion after it has not begun";
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(
      shop.recorder.lines,
      (std::vector<std::string>{"spindle", "block 1", "block 2", "output A", "block 3", "block 4",
                                "block 5", "output B", "block 6", "block 7", "end"}));
  EXPECT_EQ(shop.board.lines[0], "G21G90G94G17G91.1G49G54");
  EXPECT_EQ(shop.board.lines[1], "G92.1M5M9");
  EXPECT_EQ(shop.board.lines[2], "M3S1200");
  EXPECT_EQ(shop.board.lines[4], "G1X2") << "the feed is in force";
  EXPECT_EQ(shop.board.lines[5], "G4P0.5");
}

TEST(GrblMachine, DwellsAsLongAsItIsTold) {
  GrblShop shop;
  shop.begin();
  shop.program.dwell(12);
  shop.program.end();
  shop.pass(11);
  EXPECT_EQ(shop.machine.state(), MachineState::Running);
  ASSERT_TRUE(shop.pass_until_over(3));
  EXPECT_EQ(shop.machine.state(), MachineState::Completed) << shop.alarm();
}

TEST(GrblMachine, AlarmsInPlaceOfWhatTheBoardLacks) {
  GrblShop shop;
  shop.begin();
  shop.program.line(1, 0, 600);
  shop.program.thread(1, -10, 1.5);
  shop.program.line(9, 0, 600);
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.alarm(), "MCH0008 this machine cannot cut threads");
  EXPECT_EQ(shop.recorder.blocks, std::vector<std::uint64_t>{1}) << "everything before it";
  EXPECT_NEAR(shop.board.position()[0], 1, 1e-6);
}

struct CheckCase {
  const char* name;
  void (*program)(Program&);
  const char* refusal;
};
class GrblCheck : public testing::TestWithParam<CheckCase> {};

TEST_P(GrblCheck, FindsWhatTheBoardCannotDoWithoutMoving) {
  GrblShop shop({.start = {-50, 0, -50, 0}, .settings = {{20, "1"}}});
  const auto check = shop.machine.make_check(Program::at(-50, -50));
  Program program(check->events());
  program.line(-60, -50, 600);
  program.spindle(1200);
  EXPECT_FALSE(check->refusal());
  GetParam().program(program);
  program.line(-70, -50, 600);
  ASSERT_TRUE(check->refusal());
  EXPECT_EQ(check->refusal()->text, GetParam().refusal);
  EXPECT_EQ(check->refusal()->line, 3U) << "the first";
  shop.pass(1);
  EXPECT_TRUE(shop.board.lines.empty());
  EXPECT_TRUE(shop.machine.drained());
}

INSTANTIATE_TEST_SUITE_P(
    , GrblCheck,
    testing::Values(
        CheckCase{"thread", [](Program& it) { it.thread(-61, -60, 1.5); },
                  "this machine cannot cut threads"},
        CheckCase{"feed_per_revolution",
                  [](Program& it) { it.line(-61, -50, Feed::per_revolution(Length::mm(0.1))); },
                  "this machine cannot feed per revolution"},
        CheckCase{"travel", [](Program& it) { it.line(1, -50, 600); },
                  "X 1 mm is outside the machine's travel of -300 to 0 ($20, $23, $130)"},
        CheckCase{"spindle_speed", [](Program& it) { it.spindle(20'000); },
                  "spindle speed 20000 is above the machine's 10000 rpm ($30)"}),
    [](const auto& i) { return std::string(i.param.name); });

TEST(GrblMachine, AnAlarmOfTheProgramSwitchesTheSpindleOff) {
  GrblShop shop;
  shop.begin();
  shop.program.spindle(1200);
  shop.program.line(1, 0, 600);
  shop.program.thread(1, -10, 1.5);
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_TRUE(shop.pass_until(
      [&] { return shop.machine.status().spindle.state == interpreter::SpindleState::Off; }, 5));
  EXPECT_FALSE(shop.board.is_spindle_on());
}

interpreter::Probe probe_to(GrblShop& shop, double z) {
  interpreter::Probe probe;
  probe.origin = shop.program.begin_block();
  probe.from = Program::at(0, 0);
  probe.to = Program::at(0, z);
  probe.feed = Feed::per_minute(Length::mm(300));
  return probe;
}

TEST(GrblMachine, ProbesAndEndsAtTheContact) {
  GrblShop shop({.surface_z = -3.25});
  shop.begin();
  shop.machine.begin_probe(probe_to(shop, -10));
  shop.program.end_block();
  ASSERT_TRUE(shop.pass_until([&] { return !shop.recorder.probes.empty(); })) << shop.alarm();
  const auto& result = shop.recorder.probes[0].result;
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->tripped);
  EXPECT_NEAR(result->at.raw(Axis::Z), -3.25, 1e-6);
  EXPECT_NEAR(shop.board.position()[2], -3.25, 1e-3) << "moved back from where it has braked";
  shop.program.line(5, -3.25, 3000);
  shop.program.end();
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.machine.state(), MachineState::Completed) << shop.alarm();
  EXPECT_EQ(shop.board.lines.back(), "G1X5F3000");
}

TEST(GrblMachine, ReportsAProbeWithoutContact) {
  GrblShop shop;
  shop.begin();
  shop.machine.begin_probe(probe_to(shop, -4));
  shop.program.end_block();
  ASSERT_TRUE(shop.pass_until([&] { return !shop.recorder.probes.empty(); })) << shop.alarm();
  EXPECT_FALSE(shop.recorder.probes[0].result->tripped);
  EXPECT_NEAR(shop.z(), -4, 1e-3);
}

TEST(GrblMachine, NamesTheAlarmOfAProbeThatIsClosedBeforeItsMove) {
  GrblShop shop;
  shop.board.is_probe_closed = true;
  shop.begin();
  shop.machine.begin_probe(probe_to(shop, -4));
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.alarm(),
            "GRB0001 alarm 4 of the board, the probe was not in its rest state when the probe move "
            "began");
  EXPECT_TRUE(shop.recorder.probes.empty());
}

TEST(GrblMachine, BoundsItsReadAhead) {
  GrblShop shop;
  shop.begin();
  std::size_t blocks = 0;
  for (; shop.machine.has_room() && blocks < 5000; ++blocks)
    shop.program.line(static_cast<double>(blocks + 1) * 0.01, 0, 600);
  EXPECT_EQ(blocks, GrblMachine::kMaxActions);
  shop.pass(0.02);
  EXPECT_GT(shop.machine.buffered().count(), 0.9);
  shop.board.is_stuck = true;  // takes lines, and executes none
  for (int i = 0; i < 2000; ++i) {
    for (; shop.machine.has_room() && blocks < 50'000; ++blocks)
      shop.program.line(static_cast<double>(blocks + 1) * 0.01, 0, 600);
    shop.pass(0.002);
  }
  EXPECT_LT(blocks, GrblMachine::kMaxActions + 200) << "what the board has, and no more";
}

TEST(GrblMachine, StartsASecondProgramWhereTheFirstHasEnded) {
  GrblShop shop;
  shop.begin();
  shop.program.line(7, 0, 3000);
  shop.program.end();
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.machine.check_begin({}).error().what, "X is at 7.000, the setup begins at 0.000");
  ASSERT_TRUE(shop.machine.check_begin(Program::at(7, 0)));
  shop.begin(7, 0);
  shop.program.line(9, 0, 3000);
  shop.program.end();
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.machine.state(), MachineState::Completed) << shop.alarm();
  EXPECT_NEAR(shop.x(), 9, 1e-3);
}

}  // namespace
}  // namespace dripline::machine::grbl::test
