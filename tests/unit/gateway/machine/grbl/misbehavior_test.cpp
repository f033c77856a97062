#include "tests/unit/gateway/machine/grbl/grbl_shop.hpp"

/// A board that restarts, stalls, floods or lies: an alarm with a reason, nothing in motion that
/// no one commanded, and silence until the operator resets.
namespace dripline::machine::grbl::test {
namespace {

class GrblMisbehavior : public testing::Test {
 protected:
  void run(int blocks = 40) {
    shop.begin();
    for (int i = 1; i <= blocks; ++i) shop.program.line(i * 2, 0, 1200);
    shop.program.end();
    ASSERT_TRUE(shop.pass_until([&] { return shop.x() > 5; }));
  }
  /// Alarmed for this reason, and quiet from then on.
  void expect_alarm(const std::string& reason, double within = 10) {
    ASSERT_TRUE(shop.pass_until_over(within)) << reason;
    EXPECT_EQ(shop.machine.state(), MachineState::Alarmed);
    EXPECT_NE(shop.alarm().find(reason), std::string::npos) << shop.alarm();
    shop.pass(5);  // until the board is held and reset
    const std::size_t received = shop.board.received();
    const double traveled = shop.board.traveled();
    shop.pass(20);
    EXPECT_EQ(shop.board.received(), received) << "nothing is sent after an alarm";
    EXPECT_EQ(shop.board.traveled(), traveled);
    EXPECT_LE(shop.recorder.blocks.size(), shop.board.done.size() + silent_blocks);
    EXPECT_FALSE(shop.machine.check_begin(shop.machine.status().position));
  }
  void reset_by_operator() {
    shop.machine.set_panel({.emergency_stop = true});
    shop.pass(1);
    shop.machine.set_panel({});
    shop.pass(3);
  }
  GrblShop shop;
  std::size_t silent_blocks = 0;
};

TEST_F(GrblMisbehavior, AnErrorOfTheBoardNamesTheLine) {
  run();
  shop.board.refuses_line = 1;
  expect_alarm(
      "GRB0002 error 20 of the board, the firmware does not know a command of the line: N");
  reset_by_operator();
  EXPECT_TRUE(shop.machine.check_begin(shop.machine.status().position));
}

TEST_F(GrblMisbehavior, AnAlarmOfTheBoardIsNamed) {
  run();
  shop.board.raise_alarm(1);
  expect_alarm("GRB0001 alarm 1 of the board, a limit switch was hit");
  reset_by_operator();
  EXPECT_EQ(
      shop.machine.check_begin({}).error().what,
      "the board is in alarm 1 (a limit switch was hit: the position is lost, home the axes): "
      "home the axes ($H), or unlock it ($X)");
}

// It was zero when the gateway connected: every position would be beside its place.
TEST_F(GrblMisbehavior, AWorkOffsetThatSomethingElseHasSet) {
  shop.board.g54 = {5, 0, 0, 0};
  shop.begin();
  shop.program.line(10, 0, 1200);
  expect_alarm("GRB0008 the board's G54 is not zero any more: something else has set it");
  EXPECT_EQ(shop.board.traveled(), 0);
  reset_by_operator();
  shop.begin();
  shop.program.line(10, 0, 1200);
  shop.program.end();
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.machine.state(), MachineState::Completed) << "in one that is zero";
  EXPECT_EQ(shop.board.position()[0], 10);
}

TEST_F(GrblMisbehavior, ARestartInTheMidst) {
  run();
  shop.board.restart();
  expect_alarm("GRB0004 the board has restarted by itself");
  EXPECT_EQ(shop.board.position()[0], 0) << "lines in transit are not executed";
}

TEST_F(GrblMisbehavior, SilenceIsAHoldThatTheOperatorEnds) {
  run(400);
  shop.is_cut = true;
  shop.pass(4);
  shop.is_cut = false;
  shop.pass(1);
  EXPECT_EQ(shop.machine.state(), MachineState::Held);
  EXPECT_FALSE(shop.board.is_moving());
  EXPECT_TRUE(shop.machine.resume());
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.machine.state(), MachineState::Completed);
}

TEST_F(GrblMisbehavior, SilenceThatLastsIsAnAlarm) {
  run(400);
  shop.is_cut = true;
  expect_alarm("GRB0005 the board does not report its state: the position is unknown");
}

/// A slow board that says nothing while it thinks is held, and continues where the operator lets
/// it.
TEST_F(GrblMisbehavior, SilenceAtRestIsNoLostLine) {
  shop.begin();
  shop.program.line(3, 0, 1200);
  shop.program.stop();
  shop.program.line(30, 0, 1200);
  shop.program.end();
  ASSERT_TRUE(shop.pass_until([&] { return shop.machine.state() == MachineState::ProgramStop; }));
  shop.board.is_mute = true;
  EXPECT_TRUE(shop.machine.resume());
  shop.pass(4.5);
  shop.board.is_mute = false;
  EXPECT_EQ(shop.alarm(), "");
  EXPECT_EQ(shop.machine.state(), MachineState::Held);
  shop.pass(1);
  EXPECT_TRUE(shop.machine.resume());
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.machine.state(), MachineState::Completed) << shop.alarm();
}

TEST_F(GrblMisbehavior, ALostLine) {
  run(400);
  shop.machine.line_lost("/dev/ttyUSB0: no such device");
  expect_alarm("GRB0005 /dev/ttyUSB0: no such device: the position is unknown");
  EXPECT_FALSE(shop.machine.may_open()) << "opening a port resets many boards";
}

TEST_F(GrblMisbehavior, LinesThatWereLost) {
  run();
  shop.board.swallows_lines = true;
  shop.pass(1);
  expect_alarm("GRB0006 the board is at rest and has not answered a line", 60);
}

TEST_F(GrblMisbehavior, LinesWhoseEndIsNeverReported) {
  run(6);
  shop.board.leaked_blocks = 3;
  expect_alarm("GRB0006 the board is at rest and its reports do not show", 120);
}

TEST_F(GrblMisbehavior, ABoardThatReportsRunAndStands) {
  run();
  shop.board.is_stuck = true;
  silent_blocks = 1;  // the planner's reports go on until it is seen that the axes do not
  expect_alarm("GRB0006 the board reports Run and does not move", 60);
}

TEST_F(GrblMisbehavior, AnAnswerTooMany) {
  run(3);
  for (int i = 0; i < 4; ++i) shop.board.say("ok");
  expect_alarm("GRB0007 the board answers a line that it was never sent");
}

TEST_F(GrblMisbehavior, AReportOfALineThatWasNeverSent) {
  run();
  shop.board.say("<Run|MPos:1.000,0.000,0.000|Ln:4711|FS:100,0>");
  expect_alarm("GRB0007 the board reports line 4711, which it was not sent");
}

TEST_F(GrblMisbehavior, AReportOfALineThatHasNotComeToItsTurn) {
  shop.board.names_lines_ahead = 18;  // beyond the planner
  shop.begin();
  shop.program.line(20, 0, 1200);
  for (int i = 1; i <= 40; ++i) shop.program.line(20 + i * 2, 0, 1200);
  expect_alarm("GRB0007 the board reports line");
}

TEST_F(GrblMisbehavior, APositionWithoutAllAxes) {
  run();
  shop.board.forgets_axes = true;
  expect_alarm("GRB0007 4 lines of the board are none of its protocol");
}

TEST_F(GrblMisbehavior, AContactThatIsNotOnTheProbesPath) {
  interpreter::Probe probe;
  probe.origin = {.block = 1, .line = 1};
  probe.from = Program::at(0, 0);
  probe.to = Program::at(0, -10);
  probe.feed = Feed::per_minute(Length::mm(300));
  GrblShop other({.surface_z = -3});
  other.board.contact_is_off = 40;
  other.begin();
  other.machine.begin_probe(probe);
  ASSERT_TRUE(other.pass_until_over(20));
  EXPECT_NE(other.alarm().find("not on the probe's path"), std::string::npos) << other.alarm();
  EXPECT_EQ(other.board.position()[0], 0) << "the axes are not sent there";
}

TEST_F(GrblMisbehavior, Garbage) {
  run();
  for (int i = 0; i < 4; ++i) shop.board.say("<Run|MPos:1.0,x>");
  expect_alarm("GRB0007 4 lines of the board are none of its protocol");
}

TEST_F(GrblMisbehavior, AFlood) {
  run();
  for (int i = 0; i < 8000; ++i) shop.board.say("[MSG:all work and no play makes a dull board]");
  expect_alarm("GRB0007 the board floods the line");
}

TEST_F(GrblMisbehavior, AxesThatAreNotWhereTheyWereSent) {
  shop.board.drifts = 0.05;
  shop.begin();
  shop.program.line(3, 0, 1200);
  shop.program.output("A");
  shop.program.end();
  expect_alarm("MCH0009 X is at 3.050, the program has it at 3.000", 20);
}

TEST_F(GrblMisbehavior, CheckModeInTheMidst) {
  shop.begin();
  shop.program.line(3, 0, 1200);
  shop.program.stop();
  ASSERT_TRUE(shop.pass_until([&] { return shop.machine.state() == MachineState::ProgramStop; }));
  shop.board.enter_check_mode();
  silent_blocks = 1;  // the stop
  expect_alarm("GRB0008 the board is in state Check");
}

TEST_F(GrblMisbehavior, ABoardThatDoesNotAnswerItsReset) {
  run();
  shop.machine.abort();
  shop.board.ignores_reset = true;
  expect_alarm("GRB0005 the board does not answer a reset", 60);
  const auto resets = std::ranges::count(shop.board.real_time, '\x18');
  shop.machine.set_panel({.emergency_stop = true});
  shop.pass(0.1);
  EXPECT_GT(std::ranges::count(shop.board.real_time, '\x18'), resets)
      << "the emergency stop is sent also to a board that has obeyed none";
}

TEST_F(GrblMisbehavior, AnEmergencyStopDuringTheStopOfAFaultIsNotSlower) {
  run();
  shop.is_cut = true;
  ASSERT_TRUE(shop.pass_until_over(10));
  shop.pass(2.9);  // the stop of the fault is about to end
  shop.is_cut = false;
  shop.machine.set_panel({.emergency_stop = true});
  shop.pass(0.6);
  EXPECT_FALSE(shop.board.is_moving());
  shop.machine.set_panel({});
  shop.pass(9);
  EXPECT_TRUE(shop.pass_until([&] { return shop.machine.notice().empty(); }, 10))
      << shop.machine.notice();
}

TEST(GrblConnect, StopsABoardThatMovesWithoutAProgram) {
  GrblShop shop;
  shop.board.receive("G1X100F600\n");
  shop.pass(1);
  ASSERT_TRUE(shop.board.is_moving());
  shop.machine.line_lost("unplugged");
  shop.machine.line_opened();
  shop.pass(2);
  EXPECT_FALSE(shop.board.is_moving());
  EXPECT_LT(shop.board.position()[0], 20);
  EXPECT_TRUE(shop.machine.check_begin(shop.machine.status().position)) << "the position is kept";
}

TEST(GrblConnect, ASilentBoardIsNoMachine) {
  GrblShop shop;
  shop.machine.line_lost("unplugged");
  EXPECT_EQ(shop.machine.check_begin({}).error().what, "unplugged");
  shop.board.is_mute = true;
  shop.machine.line_opened();
  shop.pass(7);
  EXPECT_EQ(shop.machine.reopen_reason(), "the board does not answer");
}

}  // namespace
}  // namespace dripline::machine::grbl::test
